// Micromaps of which equal ones are stored once.
#pragma once

#include "filigree/micromap/quadtree.h"

#include <cstdint>
#include <optional>
#include <unordered_map>

namespace filigree::micromap {

// Collects micromaps in the order they come; the first of equal ones stays. Hashes only find candidates; the
// bits decide. `hash` is micromap::hash(tree) throughout.
class DistinctTrees {
  public:
    // The place of a tree equal to `tree`, if there is one.
    [[nodiscard]] std::optional<int32_t> find(const QuadtreeView& tree, uint64_t hash) const {
        const auto [first, last] = byHash_.equal_range(hash);
        for (auto candidate = first; candidate != last; ++candidate) {
            if (equal(list_[static_cast<size_t>(candidate->second)], tree)) return candidate->second;
        }
        return std::nullopt;
    }

    // Appends a tree that find() does not know, and gives its place.
    int32_t append(const QuadtreeView& tree, uint64_t hash) {
        const auto place = static_cast<int32_t>(list_.size());
        byHash_.emplace(hash, place);
        list_.push(tree);
        return place;
    }

    // The special index of a uniform tree; the place of any other, new or not.
    int32_t add(const QuadtreeView& tree) {
        if (isUniform(tree)) return specialIndex(uniformState(tree));
        const uint64_t key = hash(tree);
        const std::optional<int32_t> known = find(tree, key);
        return known ? *known : append(tree, key);
    }

    QuadtreeList take() && { return std::move(list_); }

  private:
    QuadtreeList list_;
    std::unordered_multimap<uint64_t, int32_t> byHash_;
};

}  // namespace filigree::micromap
