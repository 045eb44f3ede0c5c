#include "encoding/sdag_layout.h"

#include "filigree/core/bytes.h"

#include <bit>
#include <numeric>

namespace filigree::encoding::sdag {

uint64_t Head::nodeCount() const {
    return std::accumulate(nodes.begin(), nodes.end(), uint64_t{0});
}

unsigned Head::levelBits() const {
    const int used = std::popcount(levels);
    return used <= 1 ? 0 : static_cast<unsigned>(std::bit_width(static_cast<unsigned>(used - 1)));
}

uint64_t Head::descriptorBlockBytes(uint32_t mapCount) const {
    return bytes + (uint64_t{descriptorBits()} * mapCount + 7) / 8 + descriptorPadding;
}

Offsets offsetsOf(const Head& head, micromap::Format format) {
    Offsets at;
    at.heads = uint64_t{head.patterns} * patternBytes(format);
    uint64_t next = at.heads + uint64_t{head.heads} * 4;
    for (unsigned slot = 0; slot < nodeHeights; ++slot) {
        at.nodes[slot] = next;
        next += uint64_t{head.nodes[slot]} * head.nodeBytes();
    }
    at.shares = next;
    at.shared = at.shares + (head.shares ? 2 * head.nodeCount() : 0);
    at.blocks = at.shared + head.sharedBytes;
    at.padding = at.blocks + head.blockBytes;
    at.flat = at.padding + (head.hasLeaves() ? padding : 0);
    at.end = at.flat + head.flatBytes;
    return at;
}

void writeHead(const Head& head, std::span<uint8_t> to) {
    uint8_t* p = to.data();
    storeLe(p, static_cast<uint8_t>((head.shares ? 1 : 0) | (head.flatMaps ? 2 : 0)));
    storeLe(p + 1, static_cast<uint8_t>(head.baseBytes));
    storeLe(p + 2, static_cast<uint8_t>(head.referenceBits));
    storeLe(p + 3, static_cast<uint8_t>(head.valueBits));
    storeLe(p + 4, head.levels);
    storeLe(p + 8, head.patterns);
    storeLe(p + 12, head.heads);
    for (unsigned slot = 0; slot < nodeHeights; ++slot) storeLe(p + 16 + 4 * slot, head.nodes[slot]);
    storeLe(p + 32, head.sharedBytes);
    storeLe(p + 36, head.blockBytes);
    storeLe(p + 40, head.flatBytes);
}

Head readHead(std::span<const uint8_t> from) {
    const uint8_t* p = from.data();
    Head head;
    head.shares = (p[0] & 1) != 0;
    head.flatMaps = (p[0] & 2) != 0;
    head.baseBytes = p[1];
    head.referenceBits = p[2];
    head.valueBits = p[3];
    head.levels = loadLe<uint32_t>(p + 4);
    head.patterns = loadLe<uint32_t>(p + 8);
    head.heads = loadLe<uint32_t>(p + 12);
    for (unsigned slot = 0; slot < nodeHeights; ++slot)
        head.nodes[slot] = loadLe<uint32_t>(p + 16 + 4 * slot);
    head.sharedBytes = loadLe<uint32_t>(p + 32);
    head.blockBytes = loadLe<uint32_t>(p + 36);
    head.flatBytes = loadLe<uint64_t>(p + 40);
    return head;
}

}  // namespace filigree::encoding::sdag
