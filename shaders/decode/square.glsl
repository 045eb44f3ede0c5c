// What the formats of opacity squares have in common (Fenney and Ozkan 2023): places and transforms.
// docs/spec/vq2.md. The maps are the payload; there are no descriptors.
#include "blocks.glsl"

// The column or row, of `side`, that holds a coordinate; outside of 0 to 1 the nearest, 0 for NaN.
uint regionAlong(float coordinate, uint side) {
    return coordinate > 0.0 ? min(uint(min(coordinate, 1.0) * float(side)), side - 1u) : 0u;
}

// Column and row of a point with weights u and v of vertices 1 and 2 of the first or second half of a square.
uvec2 regionIn(uint half_, float u, float v, uint side) {
    const bool second = half_ != 0u;
    return uvec2(regionAlong(second ? 1.0 - u : u, side), regionAlong(second ? 1.0 - v : v, side));
}

// The cell of a stored vector of side last + 1 that a transform shows at `shown` (table 1).
uvec2 storedCell(uint transform, uint last, uvec2 shown) {
    const uint turned = 0u - (transform & 1u);
    const uint x = shown.x ^ (last & (0u - ((transform >> 2) & 1u)));
    const uint y = shown.y ^ (last & (0u - ((transform >> 1) & 1u)));
    const uint exchange = (x ^ y) & turned;
    return uvec2(x ^ exchange ^ (last & turned), y ^ exchange);
}

// 0 transparent, 1 mixed, 2 opaque.
uint regionOf(uint known, uint palette) {
    return 1u - (known & 1u) + 2u * (known & palette & 1u);
}
