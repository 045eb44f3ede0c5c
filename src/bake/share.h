// Equal micromaps are stored once.
#pragma once

#include "filigree/micromap/distinct_trees.h"

#include <cstdint>
#include <utility>

namespace filigree::bake {

// Where a micromap is to be found.
struct Shared {
    int32_t index = 0;     // special when it is uniform, else into the list
    uint8_t rotation = 0;  // the triangle's new vertex k must be its old (k + rotation) % 3
};

// Collects micromaps in the order they come; the first of equal ones stays.
class Sharer {
  public:
    // With `rotate`, micromaps that differ by a rotation of their triangle's vertices count as equal.
    explicit Sharer(bool rotate) : rotate_(rotate) {}

    // `hash` is micromap::hash(tree). Hashes only find candidates; the bits decide.
    Shared add(const micromap::QuadtreeView& tree, uint64_t hash);

    micromap::QuadtreeList take() && { return std::move(trees_).take(); }

  private:
    bool rotate_;
    micromap::DistinctTrees trees_;
};

}  // namespace filigree::bake
