// What `vq4` and `vq4+` read alike (Fenney and Ozkan 2023, section 5). docs/spec/vq4.md.
#include "square.glsl"

const uint squareSide = 32u;

// Bit `at` of the last 48 bits of a block.
uint vq4Tail(uint map, uint at, uint count) {
    return payloadBits(64u * map + 58u, at, count);
}

uint vq4Index(uint map, uvec2 at) {
    return (payloadWords[16u * map + (at.y >> 2)] >> ((at.x >> 2) * 4u)) & 15u;
}

// Bit 4y + x of the known regions of word `index`, 3 to 15.
uint vq4Known(uint map, uint index, uvec2 cell) {
    return payloadBits(64u * map + 26u + 2u * index, 4u * cell.y + cell.x, 1u);
}
