// Succinct quadtrees with a rank directory: docs/spec/indexed-tree.md. The bits are those of `tree`;
// Waldemarson and Doggett 2024, section 6.1, ask for such a directory.
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
class FILIGREE_API IndexedTreeReader {
  public:
    // Checks all of `set` and looks into its blocks from then on.
    static Result<IndexedTreeReader> open(const EncodedView& set);

    [[nodiscard]] uint32_t mapCount() const { return set_.mapCount; }
    [[nodiscard]] unsigned level(uint32_t map) const { return filigree_indexed_tree_level(&view_, map); }
    // A binary search among every 64th leaf, then at most some hundred bits a byte at a time: O(level).
    [[nodiscard]] micromap::State at(uint32_t map, uint32_t index) const {
        return static_cast<micromap::State>(filigree_indexed_tree_at(&view_, map, index));
    }
    [[nodiscard]] micromap::State at(uint32_t map, float u, float v) const {
        return static_cast<micromap::State>(filigree_indexed_tree_at_point(&view_, map, u, v));
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
    IndexedTreeReader(const EncodedView& set, const filigree_indexed_tree& view) : set_(set), view_(view) {}

    EncodedView set_;
    filigree_indexed_tree view_;
};

// Encodes `maps`. ErrorKind::limit above 4 GiB - 1 of payload.
FILIGREE_API Result<EncodedSet> encodeIndexedTree(std::span<const micromap::QuadtreeView> maps,
                                                  micromap::Format format,
                                                  const Executor& executor = serialExecutor(),
                                                  ProgressSink& progress = silentProgress());

}  // namespace filigree::encoding
