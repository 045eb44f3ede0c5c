// The binary tree of a subtree, by the surface area heuristic.
#pragma once

#include "bvh/bounds.h"

#include <cstdint>
#include <span>
#include <vector>

namespace filigree::bvh {

// A box on its way into the tree.
struct Item {
    Box box;
    uint32_t index = 0;
};

// At least one item; they get sorted. Leaves stand for an item's index. `depth` is that of the root.
std::vector<Branch> buildBinaryTree(std::span<Item> items, unsigned depth);

}  // namespace filigree::bvh
