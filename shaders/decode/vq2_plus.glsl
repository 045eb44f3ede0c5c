// Format `vq2+`: `vq2` with the order of words as a message. docs/spec/vq2-plus.md.
#include "vq2_block.glsl"

// The region of a map in a column and row: 0 transparent, 1 mixed, 2 opaque.
uint regionAt(uint map, uvec2 at) {
    const Vq2Region region = vq2Region(map, at);
    const uint first = vq2Word(region.book, 24u + 10u * region.quadrant);
    const uint second = vq2Word(region.book, 29u + 10u * region.quadrant);
    const uint reread = ((first ^ second) & 1u) != 0u ? 2u : 0u;
    if (first <= second || region.index != reread) return vq2State(region);
    const uint rotation = vq2Word(region.book, 14u) > vq2Word(region.book, 19u) ? 6u : 1u;
    return regionInWord(vq2Word(region.book, 9u), storedCell(rotation, 1u, region.cell));
}
