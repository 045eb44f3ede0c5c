// Mixed regions of opacity squares where two states are asked for: hit or miss by chance, the same for each ray and
// place (Fenney and Ozkan 2023, section 6). quadmap::isHit with Neighbourhood::two.

// How likely a hit is at weights of vertices 1 and 2 of a half, from the four regions around the point.
float opaqueChance(uint map, uint half_, vec2 weights) {
    const uint own = regionAt(map, regionIn(half_, weights.x, weights.y, squareSide));
    if (own != 1u) return 0.5 * float(own);
    const vec2 point = half_ == 0u ? weights : 1.0 - weights;
    const vec2 at = clamp(point, 0.0, 1.0) * float(squareSide) - 0.5;
    const vec2 part = at - floor(at);
    const ivec2 first = ivec2(floor(at));
    float chance = 0.0;
    for (int k = 0; k < 4; ++k) {
        const ivec2 step_ = ivec2(k & 1, k >> 1);
        const vec2 share = mix(1.0 - part, part, vec2(step_));
        const uvec2 region = uvec2(clamp(first + step_, ivec2(0), ivec2(squareSide - 1u)));
        chance += share.x * share.y * 0.5 * float(regionAt(map, region));
    }
    return chance;
}

// In [0, 1), from the bits of two weights and a seed.
float chanceDrawn(vec2 weights, uint seed) {
    return unitFloat(hashed(hashed(floatBitsToUint(weights.x) ^ seed) + floatBitsToUint(weights.y)));
}
