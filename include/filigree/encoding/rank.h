// Which of a node's present children a child is.
#pragma once

#include <bit>
#include <cstdint>

namespace filigree::encoding {

// How many of the low `child` bits of `mask` are set, child 0..15. Without the instruction, which baseline
// x86-64 lacks: four copies of the bits, 15 apart, bring each bit to the lowest place of a nibble exactly
// once; the product sums the nibbles.
inline uint32_t rankOf(uint32_t mask, uint32_t child) {
    const uint32_t before = mask & ((1u << child) - 1);
#if defined(__POPCNT__)
    return static_cast<uint32_t>(std::popcount(before));
#else
    constexpr uint64_t copies = 0x0000200040008001;
    constexpr uint64_t lowestOfNibbles = 0x1111111111111111;
    return static_cast<uint32_t>((((before * copies) & lowestOfNibbles) * lowestOfNibbles) >> 60);
#endif
}

}  // namespace filigree::encoding
