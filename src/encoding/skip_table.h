// Skips subtrees of a depth-first quadtree structure, eight bits a step.
#pragma once

#include <array>
#include <cstdint>

namespace filigree::encoding {

// Reading a bit leaves three more subtrees to skip where it is 1 and one fewer where it is 0. For each byte:
// bits 4k..4k+3 for k = 0..7: after how many bits k + 1 subtrees are skipped, 1..8, or 0 where it takes
// more; bits 40..47: 8 + the change of subtrees left over all 8 bits.
constexpr uint64_t skipEntry(unsigned byte) {
    uint64_t entry = 0;
    int change = 0;
    int least = 0;
    for (unsigned bit = 0; bit < 8; ++bit) {
        change += (byte >> bit & 1u) != 0 ? 3 : -1;
        if (change >= least) continue;
        least = change;
        entry |= uint64_t{bit + 1} << (4 * (-least - 1));
    }
    return entry | static_cast<uint64_t>(8 + change) << 40;
}

inline constexpr std::array<uint64_t, 256> skipTable = [] {
    std::array<uint64_t, 256> table{};
    for (unsigned byte = 0; byte < 256; ++byte) table[byte] = skipEntry(byte);
    return table;
}();

// After how many bits `skip` subtrees are skipped, or 0: none are to be, or it takes more than the byte.
constexpr unsigned skipLength(uint64_t entry, uint32_t skip) {
    if (skip - 1 >= 8) return 0;
    return static_cast<unsigned>(entry >> (4 * (skip - 1))) & 15u;
}

// To be added to the subtrees that are left, modulo 2^32, behind a byte that does not skip them all.
constexpr uint32_t skipBalance(uint64_t entry) {
    return static_cast<uint32_t>(entry >> 40) - 8;
}

}  // namespace filigree::encoding
