// VQ4 and VQ4+: squares of 32 x 32 regions in 512 bits (docs/spec/vq4.md; Fenney and Ozkan 2023, section 5).
#pragma once

#include "filigree/core/api.h"
#include "filigree/quadmap/square.h"
#include "filigree/quadmap/transform.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace filigree::quadmap {

// Regions along a side, and bytes of a block.
inline constexpr unsigned vq4Side = 32;
inline constexpr size_t vq4Bytes = 64;

// One block, owned or not.
using Vq4Block = std::array<uint8_t, vq4Bytes>;
using Vq4View = std::span<const uint8_t, vq4Bytes>;

// A 4 x 4 vector: the regions that are known, region x, y at bit 4y + x, and for each 2 x 2 part of it what
// its known ones are, 0 transparent, 1 opaque: top left at bit 0, top right, bottom left, bottom right.
struct Word4 {
    uint16_t known = 0;
    uint8_t palettes = 0;
    friend bool operator==(const Word4&, const Word4&) = default;
};

// What a word can hold: one palette for all of it, one for each of its left and right, or upper and lower
// half, or one for each 2 x 2 part.
enum class Word4Kind : uint8_t { simple, vertical, horizontal, generic };

// How many words there are.
inline constexpr unsigned word4Count = 13;

// The two layouts: VQ4 transforms four quadrants, VQ4+ eight half quadrants and pays for it with simpler
// words.
enum class Vq4Layout : uint8_t { vq4, vq4Plus };

// Kinds of the words of indices 3..15.
FILIGREE_API const std::array<Word4Kind, word4Count>& word4Kinds(Vq4Layout layout);

// The group of vectors, sharing a transform, that vector x, y of the 8 x 8 belongs to: in VQ4 the quadrant, 0
// top left, 1 top right, 2 bottom left, 3 bottom right; in VQ4+ twice that, and 1 more in its lower half.
constexpr unsigned groupCount(Vq4Layout layout) {
    return layout == Vq4Layout::vq4 ? 4 : 8;
}
constexpr unsigned groupOf(Vq4Layout layout, unsigned x, unsigned y) {
    const unsigned quadrant = y / 4 * 2 + x / 4;
    return layout == Vq4Layout::vq4 ? quadrant : 2 * quadrant + y / 2 % 2;
}

// What a block holds.
struct Vq4 {
    // 8 x 8, row by row. 0, 1, 2 uniform transparent, mixed, opaque; 3..15 the words.
    std::array<uint8_t, 64> indices{};
    std::array<Transform, 8> transforms{};  // of each group; in VQ4 that of group 0 is the identity
    std::array<Word4, word4Count> words{};
};

// All 512-bit patterns are blocks, and pack(unpackVq4(block)) is the block. Palettes that a word's kind
// cannot hold are misuse.
FILIGREE_API Vq4Block pack(const Vq4& map, Vq4Layout layout);
FILIGREE_API Vq4 unpackVq4(Vq4View block, Vq4Layout layout);

// The region in column x and row y, both 0..31.
FILIGREE_API Region vq4Region(Vq4View block, Vq4Layout layout, unsigned x, unsigned y);
// The bits that this reads (docs/spec/bits-read.md).
FILIGREE_API unsigned vq4BitsRead(Vq4View block, Vq4Layout layout, unsigned x, unsigned y);

}  // namespace filigree::quadmap
