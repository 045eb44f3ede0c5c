// All maps of a set as one graph in which equal parts stand once.
#pragma once

#include "filigree/core/executor.h"

#include "encoding/sdag_sparse.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace filigree::encoding::sdag {

// A node above the leaves. Children that are neither wholly transparent nor wholly opaque are `mixed`; they
// form a group, by grandchild.
struct Node {
    uint16_t mixed = 0;
    uint16_t opaque = 0;
    uint32_t group = 0;
    bool operator==(const Node&) const = default;
};

// The distinct nodes of one height and their groups.
struct Layer {
    std::vector<Node> nodes;
    std::vector<uint32_t> children;  // of all groups: leaves at height 6, else nodes of the layer below
    std::vector<uint32_t> groupEnds;

    [[nodiscard]] std::span<const uint32_t> group(uint32_t g) const {
        const uint32_t begin = g == 0 ? 0 : groupEnds[g - 1];
        return std::span(children).subspan(begin, groupEnds[g] - begin);
    }
};

// Where a map's graph begins: a leaf at height 4, else a node of the layer of its height.
struct Root {
    unsigned height = leafHeight;
    uint32_t number = 0;
};

struct Graph {
    std::vector<Leaf> leaves;
    std::array<Layer, nodeHeights> layers;  // by heightSlot
    std::vector<Root> roots;                // [map_count]
};

// Merges parts by comparing them, never by a hash alone. Only maps k with wanted[k] get a meaningful root.
Graph mergeMaps(std::span<const SparseMap> maps, const std::vector<bool>& wanted, const Executor& executor);

}  // namespace filigree::encoding::sdag
