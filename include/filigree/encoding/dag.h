// Micromaps as one graph of merged subtrees (Chernaik, Modisett and Billeter 2026): docs/spec/dag.md.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/encoding/encoded_set.h"
#include "filigree/micromap/quadtree.h"

#include "filigree_lookup.h"

#include <cstdint>
#include <span>
#include <vector>

namespace filigree::encoding {

// MapReader's functions without virtual calls; see there for ranges.
class FILIGREE_API DagReader {
  public:
    // Checks all of `set` and looks into its blocks from then on.
    static Result<DagReader> open(const EncodedView& set);

    [[nodiscard]] uint32_t mapCount() const { return set_.mapCount; }
    [[nodiscard]] unsigned level(uint32_t map) const { return filigree_dag_level(&view_, map); }
    // Two reads for two levels: a node's head and one pointer, or one word of masks.
    [[nodiscard]] micromap::State at(uint32_t map, uint32_t index) const {
        return static_cast<micromap::State>(filigree_dag_at(&view_, map, index));
    }
    [[nodiscard]] micromap::State at(uint32_t map, float u, float v) const {
        return static_cast<micromap::State>(filigree_dag_at_point(&view_, map, u, v));
    }
    void lookup(std::span<const uint32_t> maps, std::span<const uint32_t> indices,
                std::span<micromap::State> states) const;
    void lookup(std::span<const uint32_t> maps, std::span<const float> u, std::span<const float> v,
                std::span<micromap::State> states) const;

    // From the stored shares; to within 1/65535, exact for parts of up to 64 micro-triangles.
    [[nodiscard]] float opaqueShare(uint32_t map, uint32_t index, unsigned level) const;

    // Bits of at() (docs/spec/bits-read.md).
    [[nodiscard]] uint64_t bitsRead(uint32_t map, uint32_t index) const;
    [[nodiscard]] micromap::Quadtree decode(uint32_t map) const;
    [[nodiscard]] std::vector<Part> parts() const;

  private:
    // Words of each kind.
    struct Words {
        uint64_t heads = 0;
        uint64_t pointers = 0;
        uint64_t masks = 0;
        uint64_t paddingBits = 0;  // of `masks`
    };

    DagReader(const EncodedView& set, const filigree_dag& view, const Words& words)
        : set_(set), view_(view), words_(words) {}

    [[nodiscard]] uint32_t descriptor(uint32_t map) const {
        return filigree_dag_descriptor_(&view_.blocks, map);
    }
    [[nodiscard]] uint32_t word(uint32_t at) const { return filigree_dag_word_(&view_.blocks, at); }
    [[nodiscard]] float shareInLeaf(uint32_t leaf, uint32_t index, unsigned height) const;

    EncodedView set_;
    filigree_dag view_;
    Words words_;
};

// All of `maps` as one graph. ErrorKind::limit above 1 GiB of payload.
FILIGREE_API Result<EncodedSet> encodeDag(std::span<const micromap::QuadtreeView> maps,
                                          micromap::Format format,
                                          const Executor& executor = serialExecutor(),
                                          ProgressSink& progress = silentProgress());

}  // namespace filigree::encoding
