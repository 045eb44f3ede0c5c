// Format `vq4`: 32 x 32 regions in 512 bits (Fenney and Ozkan 2023, section 5). docs/spec/vq4.md.
#include "vq4_block.glsl"

// The bit of the tail that is the palette of a cell of word `index`, 3 to 15.
uint vq4PalettePlace(uint index, uvec2 cell) {
    const uvec2 part = cell >> 1;
    if (index < 6u) return 6u + index;
    if (index == 6u) return 12u + part.x;
    if (index == 7u) return 14u + part.y;
    return 16u + 4u * (index - 8u) + 2u * part.y + part.x;
}

// The region of a map in a column and row: 0 transparent, 1 mixed, 2 opaque.
uint regionAt(uint map, uvec2 at) {
    const uint index = vq4Index(map, at);
    if (index < 3u) return index;
    const uint quadrant = (at.y >> 4) * 2u + (at.x >> 4);
    const uint transform = quadrant == 0u ? 0u : vq4Tail(map, 3u * quadrant - 3u, 3u);
    const uvec2 cell = storedCell(transform, 3u, at & 3u);
    return regionOf(vq4Known(map, index, cell), vq4Tail(map, vq4PalettePlace(index, cell), 1u));
}
