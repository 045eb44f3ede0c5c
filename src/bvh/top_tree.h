// The upper part of a binary tree over many boxes, down to ranges that one thread builds a subtree of.
#pragma once

#include "filigree/core/executor.h"

#include "bvh/bounds.h"

#include <cstdint>
#include <span>
#include <vector>

namespace filigree::bvh {

struct Range {
    size_t begin = 0;  // into TopTree::indices
    size_t end = 0;
    unsigned depth = 0;  // of its branch

    [[nodiscard]] size_t count() const { return end - begin; }
};

struct TopTree {
    std::vector<Branch> branches;
    std::vector<Range> ranges;  // what the leaves stand for
    std::vector<uint32_t> indices;
};

// Ranges hold up to `rangeLimit` boxes. The same tree for any executor.
TopTree buildTopTree(std::span<const Box> boxes, size_t rangeLimit, const Executor& executor);

}  // namespace filigree::bvh
