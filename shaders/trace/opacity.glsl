// What decides a candidate hit: a state where a map has one, else the texture.

// Of each surface where what its triangles say of their maps begins, here, or none; with a bitmask its texture, or none.
layout(set = 0, binding = 4) readonly buffer Maps { uint maps[]; };

#if ENCODING >= VQ2 && ENCODING <= VQ4_PLUS
#include "chance.glsl"

// What a triangle says of its square: the map in the upper bits, its half in bit 0 and the order of its vertices in
// bits 1 to 3; or special: -1 transparent, -2 opaque, -3 and -4 mixed.

// The weights of vertices 1 and 2 of the half that a triangle stands in.
vec2 weightsInHalf(uint entry, vec2 weights) {
    // Which vertices those are, by order.
    const uvec2 vertices[6] = uvec2[](uvec2(1, 2), uvec2(2, 0), uvec2(0, 1), uvec2(2, 1), uvec2(0, 2), uvec2(1, 0));
    const float all[3] = float[](1.0 - weights.x - weights.y, weights.x, weights.y);
    const uvec2 chosen = vertices[(entry >> 1) & 7u];
    return vec2(all[chosen.x], all[chosen.y]);
}

// A state.
uint stateOfTriangle(Surface s, uint entry, uint triangle, vec2 weights) {
    const vec2 inHalf = weightsInHalf(entry, weights);
    uvec2 at = regionIn(entry & 1u, inHalf.x, inHalf.y, squareSide);
    // Where four regions meet on the shared edge, the point belongs to none that lies in the other half alone.
    const uint onEdge = squareSide - 1u - at.y;
    at.x = (entry & 1u) == 0u ? min(at.x, onEdge) : max(at.x, onEdge);
    const uint region = regionAt(entry >> 4, at);
    return region == 1u ? 3u : region >> 1;
}

// Of an unknown state that must be decided without the texture.
bool sideOf(Surface s, uint state, uint triangle, uint instance, vec2 weights, uint seed) {
    const uint entry = maps[maps[s.number] + triangle];
    const uint placeSeed = hashed(seed, hashed(triangle, hashed(instance, s.number)));
    if (entry >= 0xfffffffcu) return chanceDrawn(weights, placeSeed) < 0.5;
    const vec2 inHalf = weightsInHalf(entry, weights);
    return chanceDrawn(inHalf, placeSeed) < opaqueChance(entry >> 4, entry & 1u, inHalf);
}
#elif ENCODING == BITMASK
uint stateOfTriangle(Surface s, uint entry, uint triangle, vec2 weights) {
    const vec2 coordinates = coordinatesAt(s, cornersOf(s, triangle), weights);
    return stateAt(entry, coordinates.x, coordinates.y);
}
#elif ENCODING != NO_MAPS
uint stateOfTriangle(Surface s, uint entry, uint triangle, vec2 weights) {
    return stateAt(entry, weights.x, weights.y);
}
#endif

#if ENCODING == BITMASK
// Vertex alpha is in no bitmask.
bool hasStates(Surface s) {
    return maps[s.number] != none && !hasVertexAlphas(s);
}
uint stateOf(Surface s, uint triangle, vec2 weights, inout RayCounts counts) {
    ++counts.lookups;
    return stateOfTriangle(s, maps[s.number], triangle, weights);
}
#elif ENCODING != NO_MAPS
bool hasStates(Surface s) {
    return maps[s.number] != none;
}
uint stateOf(Surface s, uint triangle, vec2 weights, inout RayCounts counts) {
    const uint entry = maps[maps[s.number] + triangle];
    if (entry >= 0xfffffffcu) return ~entry;  // a special index
    ++counts.lookups;
    return stateOfTriangle(s, entry, triangle, weights);
}
#endif

#if ENCODING != NO_MAPS && !(ENCODING >= VQ2 && ENCODING <= VQ4_PLUS)
bool sideOf(Surface s, uint state, uint triangle, uint instance, vec2 weights, uint seed) {
    return (state & 1u) != 0u;
}
#endif

// True where a candidate is a hit.
bool accepts(Surface s, uint triangle, uint instance, vec2 weights, uint seed, bool twoStates, inout RayCounts counts) {
    ++counts.candidates;
#if ENCODING != NO_MAPS
    if (hasStates(s)) {
        const uint state = stateOf(s, triangle, weights, counts);
        if (state < 2u) return state != 0u;
        if (twoStates) return sideOf(s, state, triangle, instance, weights, seed);
    }
#endif
    ++counts.fetches;
    return textureAccepts(s, triangle, instance, weights, seed);
}
