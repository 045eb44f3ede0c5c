// Encoding `gruen`: masks in row order (Gruen, Benthin and Woop 2020; Waldemarson and Doggett 2024, figure 2).
// docs/spec/gruen.md.
#include "blocks.glsl"
#include "curve.glsl"

// Row r, counted from vertex 0, begins at place r * r.
uint rowOrderIndex(float u, float v, uint level) {
    const CurveCoordinates at = curveCoordinates(u, v, level);
    const uint flipped = ~(at.u + at.v) - at.w;
    const uint row = at.u + at.v + flipped;
    return row * row + 2u * at.v + flipped;
}

// The state of a map at weights u and v of vertices 1 and 2. Unknown states are unknown-opaque, 3.
uint stateAt(uint map, float u, float v) {
    const uint record = descriptorWords[2u * map + 1u];
    const uint value = payloadState(descriptorWords[2u * map], rowOrderIndex(u, v, record & 0xffffu));
    return (record >> 16) == 3u ? 3u * value : value;  // form 3: a set bit is "maybe opaque"
}
