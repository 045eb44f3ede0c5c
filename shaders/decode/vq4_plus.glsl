// Format `vq4+`: `vq4` with twice the transforms and simpler words. docs/spec/vq4-plus.md.
#include "vq4_block.glsl"

// The bit of the tail that is the palette of a cell of word `index`, 3 to 15.
uint vq4PalettePlace(uint index, uvec2 cell) {
    const uvec2 part = cell >> 1;
    if (index < 6u) return 24u + 4u * (index - 3u) + 2u * part.y + part.x;
    if (index == 6u) return 36u + part.x;
    if (index == 7u) return 38u + part.y;
    return 32u + index;
}

// The region of a map in a column and row: 0 transparent, 1 mixed, 2 opaque.
uint regionAt(uint map, uvec2 at) {
    const uint index = vq4Index(map, at);
    if (index < 3u) return index;
    const uint quadrant = (at.y >> 4) * 2u + (at.x >> 4);
    const uint group = 2u * quadrant + ((at.y >> 3) & 1u);
    const uvec2 cell = storedCell(vq4Tail(map, 3u * group, 3u), 3u, at & 3u);
    return regionOf(vq4Known(map, index, cell), vq4Tail(map, vq4PalettePlace(index, cell), 1u));
}
