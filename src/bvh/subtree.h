// The hierarchy over some thousand boxes, built by one thread.
#pragma once

#include "filigree/bvh/node.h"
#include "filigree/core/box.h"

#include <cstdint>
#include <span>
#include <vector>

namespace filigree::bvh {

// No branch of the binary tree lies deeper, so that no way down the nodes is longer than maxDepth.
inline constexpr unsigned maxBranchDepth = 60;

// Where a binary tree `depth` branches down must halve its `count` boxes to stay above maxBranchDepth.
bool mustHalve(unsigned depth, size_t count);

// Indices count from its own first node and leaf.
struct Subtree {
    std::vector<Node> nodes;
    std::vector<uint32_t> order;  // [leaf_count], leaf k is box order[k]
};

// Over boxes[k] for k of `indices`, at least 2. `depth` of its root in the whole binary tree.
Subtree buildSubtree(std::span<const Box> boxes, std::span<const uint32_t> indices, unsigned depth);

}  // namespace filigree::bvh
