// What `vq2` and `vq2+` read alike (Fenney and Ozkan 2023, section 4). docs/spec/vq2.md.
#include "square.glsl"

const uint squareSide = 16u;

// What a block says of one region.
struct Vq2Region {
    uvec2 book;  // the block's last 64 bits
    uint index;
    uint quadrant;
    uvec2 cell;  // of the stored vector
};

Vq2Region vq2Region(uint map, uvec2 at) {
    const uint block = 32u * map;
    const uint index = payloadBits(block + 3u * (at.y >> 1), 3u * (at.x >> 1), 3u);
    const uvec2 book = uvec2(payloadWords[8u * map + 6u], payloadWords[8u * map + 7u]);
    const uint quadrant = (at.y >> 3) * 2u + (at.x >> 3);
    const uint transform = ((book.x & 511u) << 3 >> (3u * quadrant)) & 7u;
    return Vq2Region(book, index, quadrant, storedCell(transform, 1u, at & 1u));
}

// The word of five bits from bit `from` of the book up.
uint vq2Word(uvec2 book, uint from) {
    return (from >= 32u ? book.y >> (from - 32u) : funnelShift(book.x, book.y, from)) & 31u;
}

uint regionInWord(uint word, uvec2 cell) {
    return regionOf(word >> (2u * cell.y + cell.x), word >> 4);
}

uint vq2State(Vq2Region region) {
    if (region.index < 3u) return region.index;
    const uint own = region.index >= 6u ? 10u * region.quadrant : 0u;
    return regionInWord(vq2Word(region.book, 5u * region.index - 6u + own), region.cell);
}
