// Equal micromaps are stored once.
#pragma once

#include "filigree/micromap/set.h"

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

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

    micromap::QuadtreeList take() && { return std::move(list_); }

  private:
    [[nodiscard]] std::optional<int32_t> find(const micromap::QuadtreeView& tree, uint64_t hash) const;

    bool rotate_;
    micromap::QuadtreeList list_;
    std::unordered_multimap<uint64_t, int32_t> byHash_;
};

}  // namespace filigree::bake
