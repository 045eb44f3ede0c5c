// Succinct quadtrees that are read by scanning: docs/spec/tree.md. Waldemarson and Doggett 2024, section 4.
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
class FILIGREE_API TreeReader {
  public:
    // Checks all of `set` and looks into its blocks from then on.
    static Result<TreeReader> open(const EncodedView& set);

    [[nodiscard]] uint32_t mapCount() const { return set_.mapCount; }
    [[nodiscard]] unsigned level(uint32_t map) const { return filigree_tree_level(&view_, map); }
    // Algorithm 3 as it is published: reads the structure bit by bit up to the leaf, about four times as long
    // at each level.
    [[nodiscard]] micromap::State at(uint32_t map, uint32_t index) const {
        return static_cast<micromap::State>(filigree_tree_at(&view_, map, index));
    }
    [[nodiscard]] micromap::State at(uint32_t map, float u, float v) const {
        return static_cast<micromap::State>(filigree_tree_at_point(&view_, map, u, v));
    }
    void lookup(std::span<const uint32_t> maps, std::span<const uint32_t> indices,
                std::span<micromap::State> states) const;
    void lookup(std::span<const uint32_t> maps, std::span<const float> u, std::span<const float> v,
                std::span<micromap::State> states) const;
    // Bits of at() (docs/spec/bits-read.md).
    [[nodiscard]] uint64_t bitsRead(uint32_t map, uint32_t index) const;
    [[nodiscard]] micromap::Quadtree decode(uint32_t map) const;
    [[nodiscard]] std::vector<Part> parts() const;

  private:
    TreeReader(const EncodedView& set, const filigree_tree& view) : set_(set), view_(view) {}

    EncodedView set_;
    filigree_tree view_;
};

// Encodes `maps` (algorithms 1 and 2). ErrorKind::limit above 4 GiB - 1 of payload.
FILIGREE_API Result<EncodedSet> encodeTree(std::span<const micromap::QuadtreeView> maps,
                                           micromap::Format format,
                                           const Executor& executor = serialExecutor(),
                                           ProgressSink& progress = silentProgress());

}  // namespace filigree::encoding
