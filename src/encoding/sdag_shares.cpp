#include "encoding/sdag_shares.h"

#include "filigree/core/bytes.h"
#include "filigree/micromap/state.h"

#include <bit>

namespace filigree::encoding::sdag {
namespace {

uint64_t opaqueCount(const Leaf& leaf) {
    uint64_t count = 0;
    for (const Pattern pattern : leaf.patterns) {
        count += static_cast<unsigned>(std::popcount(pattern & uniformPattern(1)));
    }
    return count;
}

}  // namespace

void writeShares(const Graph& graph, const Placement& placement, uint8_t* to) {
    std::vector<uint64_t> below;
    for (const Leaf& leaf : graph.leaves) below.push_back(opaqueCount(leaf));
    for (unsigned slot = 0; slot < nodeHeights; ++slot) {
        const Layer& layer = graph.layers[slot];
        const uint64_t childSize = micromap::microTriangleCount(leafHeight + 2 * slot);
        const uint64_t size = 16 * childSize;
        std::vector<uint64_t> counts;
        for (const Node& node : layer.nodes) {
            uint64_t count = childSize * static_cast<unsigned>(std::popcount(node.opaque));
            for (const uint32_t child : layer.group(node.group)) count += below[child];
            counts.push_back(count);
        }
        for (const uint32_t number : placement.nodes[slot]) {
            storeLe(to, static_cast<uint16_t>((counts[number] * 65535 + size / 2) / size));
            to += 2;
        }
        below = std::move(counts);
    }
}

}  // namespace filigree::encoding::sdag
