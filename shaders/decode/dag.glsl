// Encoding `dag`: equal subtrees once (Chernaik, Modisett and Billeter 2026). docs/spec/dag.md.
#include "blocks.glsl"
#include "curve.glsl"

// The state of a map at weights u and v of vertices 1 and 2.
uint stateAt(uint map, float u, float v) {
    const uint descriptor = descriptorWords[map];
    const uint level = descriptor >> 28;
    const uint index = curveIndex(u, v, level);
    uint node = descriptor & 0xfffffffu;
    // Four bits a node; the last four number a state in a mask.
    for (uint shift = level <= 4u ? 4u : 4u * ((level + 1u) / 2u) - 4u; shift > 4u; shift -= 4u) {
        const uint head = payloadWords[node];
        const uint child = (index >> shift) & 15u;
        if (((head >> child) & 1u) == 0u) return 0u;
        node = payloadWords[node + 1u + rankOf(head, child)];
    }
    const uint head = payloadWords[node];
    const uint child = (index >> 4) & 15u;
    if (((head >> child) & 1u) == 0u) return 0u;
    return payloadState(4u * node + 4u, 16u * rankOf(head, child) + (index & 15u));
}
