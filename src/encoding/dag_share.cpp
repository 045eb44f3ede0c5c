#include "filigree/encoding/dag.h"

#include "encoding/dag_layout.h"

#include <algorithm>
#include <bit>
#include <cassert>

namespace filigree::encoding {

namespace {

constexpr float fullShare = 65535;

}  // namespace

// Walks down to the node that `index` lies in or is. Half-way between two nodes the share is the mean of four
// children's; in a leaf it is counted.
float DagReader::opaqueShare(uint32_t map, uint32_t index, unsigned level) const {
    assert(level <= this->level(map) && index < micromap::microTriangleCount(level));
    const unsigned wanted = this->level(map) - level;  // height of the part
    unsigned height = dag::rootHeight(this->level(map));
    for (uint32_t node = descriptor(map) & dag::rootMask;; height -= 2) {
        const uint32_t head = word(node);
        if (height == wanted) return static_cast<float>(head >> 16) / fullShare;
        if (height == dag::leafHeight) return shareInLeaf(node, index, wanted);
        if (height == wanted + 1) {
            uint32_t sum = 0;
            for (uint32_t child = 4 * (index & 3); child < 4 * (index & 3) + 4; ++child) {
                if (((head >> child) & 1) != 0)
                    sum += word(word(node + 1 + filigree_rank16(head, child))) >> 16;
            }
            return static_cast<float>(sum) / (4 * fullShare);
        }
        const uint32_t child = (index >> (2 * (height - 2 - wanted))) & 15;
        if (((head >> child) & 1) == 0) return 0;
        node = word(node + 1 + filigree_rank16(head, child));
    }
}

// The share of the part `index` of those of `height` in a leaf; bits above the leaf are ignored.
float DagReader::shareInLeaf(uint32_t leaf, uint32_t index, unsigned height) const {
    const auto count = static_cast<uint32_t>(micromap::microTriangleCount(height));
    const uint32_t first = (index * count) & 255;
    const uint32_t inBlock = std::min(count, 16u);
    const uint32_t head = word(leaf);
    uint32_t opaque = 0;
    for (uint32_t at = first; at < first + count; at += inBlock) {
        if (((head >> (at / 16)) & 1) == 0) continue;
        const uint32_t bit = (16 * filigree_rank16(head, at / 16) + at % 16) << view_.blocks.state_shift;
        // The bits on which the opaque sides of a block's states stand.
        const uint32_t sides =
            (view_.blocks.state_shift != 0 ? 0x55555555u : 0xffffu) &
            static_cast<uint32_t>((uint64_t{1} << (inBlock << view_.blocks.state_shift)) - 1);
        opaque += static_cast<uint32_t>(std::popcount((word(leaf + 1 + bit / 32) >> (bit % 32)) & sides));
    }
    return static_cast<float>(opaque) / static_cast<float>(count);
}

}  // namespace filigree::encoding
