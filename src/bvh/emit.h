// One node out of the branches that became its children.
#pragma once

#include "filigree/bvh/node.h"

#include "bvh/collapse.h"
#include "bvh/quantise.h"
#include "bvh/slot_order.h"

#include <array>
#include <cstdint>
#include <span>

namespace filigree::bvh {

// Price of a node's memory for Collapse.
double nodePriceOf(std::span<const Branch> tree);

// A node without its places, and its children in slot order.
struct NodeParts {
    Node node;
    std::array<uint32_t, width> innerBranches{};
    std::array<uint32_t, width> leafItems{};  // what the leaves stand for
    size_t innerCount = 0;
    size_t leafCount = 0;

    [[nodiscard]] std::span<const uint32_t> inner() const {
        return std::span(innerBranches).first(innerCount);
    }
    [[nodiscard]] std::span<const uint32_t> leaves() const { return std::span(leafItems).first(leafCount); }

    void addInner(size_t slot, uint32_t branch) {
        node.innerMask = static_cast<uint8_t>(node.innerMask | 1U << slot);
        innerBranches[innerCount++] = branch;
    }
    void addLeaf(size_t slot, uint32_t item) {
        node.leafMask = static_cast<uint8_t>(node.leafMask | 1U << slot);
        leafItems[leafCount++] = item;
    }
};

// isLeaf(branch): whether a child is one leaf, not a node.
template <class IsLeaf>
NodeParts partsOf(std::span<const Branch> tree, const Children& children, const IsLeaf& isLeaf) {
    NodeParts parts;
    std::array<Box, width> given;
    for (size_t k = 0; k < children.count; ++k) {
        const Bounds& bounds = tree[children.branches[k]].bounds;
        given[k] = {bounds.low, bounds.high};
    }
    const SlotOrder order = slotOrder(std::span(given).first(children.count));
    parts.node.slotAxes = order.axes;
    std::array<Box, width> boxes;
    for (size_t slot = 0; slot < width; ++slot) {
        const size_t k = order.childOf[slot];
        if (k == SlotOrder::none) continue;
        boxes[slot] = given[k];
        const Branch& child = tree[children.branches[k]];
        if (isLeaf(child)) {
            parts.addLeaf(slot, child.right);
        } else {
            parts.addInner(slot, children.branches[k]);
        }
    }
    setBoxes(parts.node, boxes);
    return parts;
}

}  // namespace filigree::bvh
