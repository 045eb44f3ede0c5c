// What a lookup in an sdag reads: docs/spec/bits-read.md.
#include "filigree/encoding/sdag.h"

#include <bit>

namespace filigree::encoding {

using namespace micromap;

uint64_t SdagReader::bitsRead(uint32_t map, uint32_t index) const {
    const uint64_t from = descriptor(map);
    const uint64_t bits = layout_.descriptorBits;
    if (isFlat(from)) return bits + bitsPerState(set_.format);
    const unsigned level = levelOf(from);
    const Planes p = turned(planesOfIndex(index, level), symmetryOf(from));
    uint32_t number = valueOf(from);
    if (level <= 4) return bits + bitsReadInLeaf(payload_ + layout_.shared + number, p);
    uint64_t nodes = 0;
    for (unsigned height = (level + 1) & ~1u;; height -= 2) {
        const NodeHead head = node(height, number);
        const uint32_t child = grandchildAt(p, height - 2);
        nodes += 8 * layout_.nodeBytes;
        if (((head.mixed >> child) & 1) == 0) return bits + nodes;
        if (height == 6) {
            const bool shared = ((head.opaque >> child) & 1) != 0;
            return bits + nodes + (shared ? layout_.referenceBits : 8) +
                   bitsReadInLeaf(leafUnder(head, child), p);
        }
        number = head.base + rankOf(head.mixed, child);
    }
}

uint64_t SdagReader::bitsReadInLeaf(const uint8_t* leaf, Planes p) const {
    const LeafHead head = leafHead(leaf);
    const uint32_t child = grandchildAt(p, 2);
    const uint64_t pattern = fourState_ ? 32 : 16;
    if (head.codes == nullptr) return 16 + pattern;
    // The head stands in the table or behind the escape.
    const uint64_t bits = 32 + (leaf[0] == escape ? 16 : leaf[0] < shortCodes ? 8 : 16);
    if (((head.mixed >> child) & 1) == 0) return bits;
    const uint32_t rank = rankOf(head.mixed, child);
    const uint32_t code = head.codes[rank];
    if (code < shortCodes) return bits + 8 + pattern;
    // Which second byte is its own shows in all first ones.
    const uint64_t firsts = 8 * static_cast<uint64_t>(std::popcount(head.mixed));
    return bits + firsts + (code == escape ? pattern : 8 + pattern);
}

}  // namespace filigree::encoding
