// The order of micro-triangles, and where a point lies in it: the reference function of VK_KHR_opacity_micromap,
// with all levels at once (Waldemarson and Doggett 2024, section 4.3; docs/spec/flat.md).
#ifndef FILIGREE_DECODE_CURVE
#define FILIGREE_DECODE_CURVE

// The barycentrics times 2^level, rounded down; the low `level` bits of w make u + v + w = -1, or -2 where the
// micro-triangle is flipped.
struct CurveCoordinates {
    uint u;
    uint v;
    uint w;
};

// A weight times n = 2^level, clamped to the triangle; NaN counts as 0.
float scaledWeight(float weight, uint n) {
    return weight > 0.0 ? min(weight, 1.0) * float(n) : 0.0;
}

// Those of the micro-triangle at weights u and v of vertices 1 and 2, ties included. level 0 to 15.
CurveCoordinates curveCoordinates(float u, float v, uint level) {
    const uint n = 1u << level;
    const precise float scaledU = scaledWeight(u, n);
    const precise float scaledV = scaledWeight(v, n);
    const precise float fractions = (scaledU - floor(scaledU)) + (scaledV - floor(scaledV));
    uint iu = min(uint(scaledU), n - 1u);
    const uint iv = min(uint(scaledV), n - 1u);
    const uint sum = iu + iv;
    if (sum >= n) iu -= sum - n + 1u;
    const uint flipped = fractions >= 1.0 && sum < n - 1u ? 1u : 0u;
    return CurveCoordinates(iu, iv, ~(iu + iv) - flipped);
}

// Spreads the low 16 bits to the even places.
uint spreadBits(uint bits) {
    bits = (bits | (bits << 8)) & 0x00ff00ffu;
    bits = (bits | (bits << 4)) & 0x0f0f0f0fu;
    bits = (bits | (bits << 2)) & 0x33333333u;
    return (bits | (bits << 1)) & 0x55555555u;
}

// Each bit becomes the parity of itself and all higher ones, in the low 16 bits.
uint prefixParity(uint bits) {
    bits ^= bits >> 1;
    bits ^= bits >> 2;
    bits ^= bits >> 4;
    return bits ^ (bits >> 8);
}

// The place along the curve of the micro-triangle that holds a point.
uint curveIndex(float u, float v, uint level) {
    const CurveCoordinates at = curveCoordinates(u, v, level);
    const uint mask = (1u << level) - 1u;
    const uint low = ~(at.u ^ at.w) & mask;
    const uint tie = (at.u ^ at.v) & low;
    const uint high = ((prefixParity(tie) ^ at.u) & ~low & mask) | tie;
    return spreadBits(low) | (spreadBits(high) << 1);
}

#endif
