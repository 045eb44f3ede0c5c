// Builds hierarchies over boxes.
#pragma once

#include "filigree/bvh/node.h"
#include "filigree/core/api.h"
#include "filigree/core/box.h"
#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"

#include <cstdint>
#include <span>
#include <vector>

namespace filigree::bvh {

// A hierarchy as build() makes it.
struct Bvh {
    std::vector<Node> nodes;      // the first is the root; children stand behind their parents
    std::vector<uint32_t> order;  // [leaf_count], leaf k is box order[k]
};

// A binned SAH tree, collapsed to 8 children a node so that nodes are full. Every node's child boxes contain
// the boxes given. None may be empty or reach 2^127, at least one is needed, at most 2^31. The same nodes for
// any executor. Beside the result it needs some 10 bytes a box, and memory for the subtrees that are being
// built: at most 65,536 boxes each.
FILIGREE_API Bvh build(std::span<const Box> boxes, const Executor& executor);

// The same, shown and stopped by the caller: progress in boxes, ErrorKind::cancelled. ErrorKind::usage for
// boxes that may not be.
FILIGREE_API Result<Bvh> build(std::span<const Box> boxes, const Executor& executor, ProgressSink& progress);

// What traversal relies on: children behind their parents, each node and each of `leafCount` leaves in one
// place, and no way down longer than maxDepth.
inline constexpr unsigned maxDepth = 64;
FILIGREE_API Status check(std::span<const Node> nodes, uint64_t leafCount);

}  // namespace filigree::bvh
