#include "encoding/sdag_place.h"

#include <algorithm>
#include <bit>
#include <numeric>

namespace filigree::encoding::sdag {
namespace {

constexpr uint32_t unplaced = UINT32_MAX;

// Roots first, so that descriptors stay narrow, then groups in the order of the nodes above them.
void placeNodes(const Graph& graph, const std::vector<bool>& wanted, Placement& to) {
    for (unsigned slot = 0; slot < nodeHeights; ++slot) {
        to.groups[slot].assign(graph.layers[slot].groupEnds.size(), unplaced);
    }
    for (unsigned slot = nodeHeights; slot-- > 0;) {
        std::vector<bool> isRoot(graph.layers[slot].nodes.size());
        std::vector<uint32_t> roots;
        for (size_t k = 0; k < graph.roots.size(); ++k) {
            const Root& root = graph.roots[k];
            if (!wanted[k] || root.height == leafHeight || heightSlot(root.height) != slot) continue;
            if (!isRoot[root.number]) roots.push_back(root.number);
            isRoot[root.number] = true;
        }
        to.nodes[slot] = std::move(roots);
        if (slot + 1 == nodeHeights) continue;
        const Layer& above = graph.layers[slot + 1];
        for (const uint32_t number : to.nodes[slot + 1]) {
            const uint32_t group = above.nodes[number].group;
            if (to.groups[slot + 1][group] != unplaced) continue;
            to.groups[slot + 1][group] = static_cast<uint32_t>(to.nodes[slot].size());
            const auto children = above.group(group);
            to.nodes[slot].insert(to.nodes[slot].end(), children.begin(), children.end());
        }
    }
}

void orderBlocks(const Graph& graph, Placement& to) {
    std::vector<bool> seen(graph.layers[0].groupEnds.size());
    for (const uint32_t number : to.nodes[0]) {
        const uint32_t group = graph.layers[0].nodes[number].group;
        if (!seen[group]) to.blocks.push_back(group);
        seen[group] = true;
    }
}

// Leaves that are roots, or that blocks refer to more than once, by falling frequency.
void chooseShared(const Graph& graph, const std::vector<bool>& wanted, Placement& to) {
    std::vector<uint32_t> uses(graph.leaves.size());
    for (const uint32_t block : to.blocks) {
        for (const uint32_t leaf : graph.layers[0].group(block)) ++uses[leaf];
    }
    for (size_t k = 0; k < graph.roots.size(); ++k) {
        if (wanted[k] && graph.roots[k].height == leafHeight) uses[graph.roots[k].number] += 2;
    }
    to.isShared.resize(graph.leaves.size());
    for (uint32_t leaf = 0; leaf < uses.size(); ++leaf) {
        if (uses[leaf] < 2) continue;
        to.isShared[leaf] = true;
        to.sharedLeaves.push_back(leaf);
    }
    std::ranges::stable_sort(to.sharedLeaves, [&](uint32_t a, uint32_t b) { return uses[a] > uses[b]; });
}

void addressShared(std::span<const uint8_t> leafBytes, Placement& to) {
    to.leafAddress.assign(leafBytes.size(), unplaced);
    to.sharedBytes = 0;
    for (const uint32_t leaf : to.sharedLeaves) {
        to.leafAddress[leaf] = static_cast<uint32_t>(to.sharedBytes);
        to.sharedBytes += leafBytes[leaf];
    }
    if (to.sharedLeaves.empty()) return;
    // At least one bit, so that no block is empty and two blocks never begin at one place.
    const uint32_t last = std::max(1u, to.leafAddress[to.sharedLeaves.back()]);
    to.referenceBits = std::max(to.referenceBits, static_cast<unsigned>(std::bit_width(last)));
}

// The bytes of a block; a leaf whose offset does not fit becomes a shared one.
uint32_t sizeBlock(std::span<const uint32_t> leaves, std::span<const uint8_t> leafBytes, Placement& to,
                   bool& moved) {
    unsigned bits = 0;
    for (const uint32_t leaf : leaves) bits += to.isShared[leaf] ? to.referenceBits : offsetBits;
    uint32_t end = (bits + 7) / 8;
    for (const uint32_t leaf : leaves) {
        if (to.isShared[leaf]) continue;
        if (end >> offsetBits != 0) {
            to.isShared[leaf] = true;
            to.sharedLeaves.push_back(leaf);
            moved = true;
            continue;
        }
        end += leafBytes[leaf];
    }
    return end;
}

}  // namespace

Placement place(const Graph& graph, std::span<const uint8_t> leafBytes, const std::vector<bool>& wanted) {
    Placement to;
    placeNodes(graph, wanted, to);
    orderBlocks(graph, to);
    chooseShared(graph, wanted, to);
    // References only grow wider and leaves only become shared, so this ends.
    for (bool moved = true; moved;) {
        moved = false;
        addressShared(leafBytes, to);
        to.blockBytes = 0;
        for (const uint32_t block : to.blocks) {
            to.groups[0][block] = static_cast<uint32_t>(to.blockBytes);
            to.blockBytes += sizeBlock(graph.layers[0].group(block), leafBytes, to, moved);
        }
    }
    return to;
}

}  // namespace filigree::encoding::sdag
