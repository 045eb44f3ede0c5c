// Encoding `flat`: micromaps as the APIs take them. docs/spec/flat.md.
#include "blocks.glsl"
#include "curve.glsl"

// The state of a map at weights u and v of vertices 1 and 2.
uint stateAt(uint map, float u, float v) {
    const uint level = descriptorWords[2u * map + 1u] & 0xffffu;
    return payloadState(descriptorWords[2u * map], curveIndex(u, v, level));
}
