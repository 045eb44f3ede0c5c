// Where the nodes and leaves of a graph go.
#pragma once

#include "encoding/sdag_codes.h"
#include "encoding/sdag_graph.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace filigree::encoding::sdag {

// A graph laid out (docs/spec/sdag.md). Addresses of shared leaves count from the shared leaves' begin, those
// of blocks from the blocks' begin.
struct Placement {
    // Nodes of each height in file order: first the roots, then groups of children; into Layer::nodes. A node
    // stands once in each group that has it.
    std::array<std::vector<uint32_t>, nodeHeights> nodes;
    // Where each group begins: the number of a node below, or the address of a block. [group_count] a layer.
    std::array<std::vector<uint32_t>, nodeHeights> groups;
    std::vector<uint32_t> blocks;        // groups of height 6, in file order
    std::vector<uint32_t> sharedLeaves;  // in file order
    std::vector<uint32_t> leafAddress;   // [leaf_count], of shared leaves
    std::vector<bool> isShared;          // [leaf_count]; other leaves stand in the one block that has them
    unsigned referenceBits = 0;
    uint64_t sharedBytes = 0;
    uint64_t blockBytes = 0;
};

// `leafBytes` by leaf.
Placement place(const Graph& graph, std::span<const uint8_t> leafBytes, const std::vector<bool>& wanted);

// References to leaves in their own block are offsets of so many bits.
inline constexpr unsigned offsetBits = 8;

}  // namespace filigree::encoding::sdag
