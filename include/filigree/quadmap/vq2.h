// VQ2 and VQ2+: squares of 16 x 16 regions in 256 bits (docs/spec/vq2.md; Fenney and Ozkan 2023, section 4).
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
inline constexpr unsigned vq2Side = 16;
inline constexpr size_t vq2Bytes = 32;

// One block, owned or not.
using Vq2Block = std::array<uint8_t, vq2Bytes>;
using Vq2View = std::span<const uint8_t, vq2Bytes>;

// A 2 x 2 vector in 5 bits: bits 0..3 set where a region is known, region x, y at bit 2y + x; bit 4 says what
// the known ones are, 0 transparent, 1 opaque.
using Word2 = uint8_t;

// What a block holds. Quadrants are 0 top left, 1 top right, 2 bottom left, 3 bottom right.
struct Vq2 {
    // 8 x 8, row by row. 0, 1, 2 uniform transparent, mixed, opaque; 3, 4, 5 shared; 6, 7 the quadrant's own.
    std::array<uint8_t, 64> indices{};
    std::array<Transform, 4> transforms{};  // of each quadrant; that of quadrant 0 is the identity
    std::array<Word2, 3> shared{};
    std::array<std::array<Word2, 2>, 4> own{};
};

// All 256-bit patterns are blocks, and pack(unpack(block)) is the block.
FILIGREE_API Vq2Block pack(const Vq2& map);
FILIGREE_API Vq2 unpackVq2(Vq2View block);

// The region in column x and row y, both 0..15, read as VQ2 or as VQ2+.
FILIGREE_API Region vq2Region(Vq2View block, unsigned x, unsigned y);
FILIGREE_API Region vq2PlusRegion(Vq2View block, unsigned x, unsigned y);
// The bits that this reads (docs/spec/bits-read.md).
FILIGREE_API unsigned vq2BitsRead(Vq2View block, unsigned x, unsigned y);
FILIGREE_API unsigned vq2PlusBitsRead(Vq2View block, unsigned x, unsigned y);

// In VQ2+ the order of words is a message: what a quadrant makes of it.
struct Vq2PlusReading {
    bool rereads = false;    // an index of the quadrant stands for the first shared word once more
    uint8_t index = 0;       // which: 0 or 2
    Transform rotation = 0;  // of that word, before the quadrant's transform
};
FILIGREE_API Vq2PlusReading vq2PlusReading(const Vq2& map, unsigned quadrant);

}  // namespace filigree::quadmap
