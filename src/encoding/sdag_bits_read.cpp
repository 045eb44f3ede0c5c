// What a lookup in an sdag reads: docs/spec/bits-read.md.
#include "filigree/encoding/sdag.h"

#include "encoding/sdag_layout.h"

#include <bit>

namespace filigree::encoding {

namespace {

uint64_t bitsReadInLeaf(const filigree_sdag& view, const uint8_t* bytes, filigree_planes p) {
    const filigree_sdag_leaf leaf = filigree_sdag_leaf_(&view, bytes);
    const uint32_t child = filigree_sdag_grandchild_(p, 2);
    const uint64_t pattern = view.four_state != 0 ? 32 : 16;
    if (leaf.codes == nullptr) return 16 + pattern;
    // The head stands in the table or behind the escape.
    const uint64_t bits = 32 + (bytes[0] == sdag::escape ? 16 : bytes[0] < sdag::shortCodes ? 8 : 16);
    if (((leaf.mixed >> child) & 1) == 0) return bits;
    const uint32_t rank = filigree_rank16(leaf.mixed, child);
    const uint32_t code = leaf.codes[rank];
    if (code < sdag::shortCodes) return bits + 8 + pattern;
    // Which second byte is its own shows in all first ones.
    const uint64_t firsts = 8 * static_cast<uint64_t>(std::popcount(leaf.mixed));
    return bits + firsts + (code == sdag::escape ? pattern : 8 + pattern);
}

}  // namespace

uint64_t SdagReader::bitsRead(uint32_t map, uint32_t index) const {
    const uint64_t from = filigree_sdag_descriptor_(&view_, map);
    const uint64_t bits = view_.descriptor_bits;
    if (filigree_sdag_is_flat_(&view_, from) != 0) return bits + micromap::bitsPerState(set_.format);
    const unsigned level = filigree_sdag_level_of_(&view_, from);
    const filigree_planes p = filigree_planes_turned(filigree_planes_of_index(index, level),
                                                     filigree_sdag_symmetry_of_(&view_, from));
    uint32_t number = filigree_sdag_value_of_(&view_, from);
    if (level <= 4) return bits + bitsReadInLeaf(view_, view_.payload + view_.at.shared + number, p);
    uint64_t nodes = 0;
    for (unsigned height = (level + 1) & ~1u;; height -= 2) {
        const filigree_sdag_node node = filigree_sdag_node_(&view_, height, number);
        const uint32_t child = filigree_sdag_grandchild_(p, height - 2);
        nodes += 8 * view_.node_bytes;
        if (((node.mixed >> child) & 1) == 0) return bits + nodes;
        if (height == 6) {
            const bool shared = ((node.opaque >> child) & 1) != 0;
            return bits + nodes + (shared ? view_.reference_bits : 8) +
                   bitsReadInLeaf(view_, filigree_sdag_leaf_under_(&view_, node, child), p);
        }
        number = node.base + filigree_rank16(node.mixed, child);
    }
}

}  // namespace filigree::encoding
