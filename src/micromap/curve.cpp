#include "filigree/micromap/curve.h"

#include <algorithm>
#include <cassert>

namespace filigree::micromap {
namespace {

// Spreads the low 16 bits of `bits` to the even places.
uint32_t spread(uint32_t bits) {
    bits = (bits | (bits << 8)) & 0x00ff00ffu;
    bits = (bits | (bits << 4)) & 0x0f0f0f0fu;
    bits = (bits | (bits << 2)) & 0x33333333u;
    return (bits | (bits << 1)) & 0x55555555u;
}

// Each bit becomes the parity of itself and all higher ones, in the low 16 bits.
uint32_t prefixParity(uint32_t bits) {
    bits ^= bits >> 1;
    bits ^= bits >> 2;
    bits ^= bits >> 4;
    return bits ^ (bits >> 8);
}

// The interleaving step of the reference function (VK_KHR_opacity_micromap, appendix), on integer
// coordinates.
uint32_t interleave(uint32_t u, uint32_t v, uint32_t w, unsigned level) {
    const uint32_t low = ~(u ^ w) & ((1u << level) - 1);
    const uint32_t tie = (u ^ v) & low;
    const uint32_t high = ((prefixParity(tie) ^ u) & ~low & ((1u << level) - 1)) | tie;
    return spread(low) | (spread(high) << 1);
}

}  // namespace

uint32_t curveIndex(LatticeTriangle triangle, unsigned level) {
    assert(level <= 15 && triangle.i + triangle.j + (triangle.flipped ? 2 : 1) <= (1u << level));
    const uint32_t w = ~(triangle.i + triangle.j) - (triangle.flipped ? 1 : 0);
    return interleave(triangle.i, triangle.j, w, level);
}

LatticeTriangle latticeTriangle(uint32_t index, unsigned level) {
    assert(level <= 15 && index < (1ull << (2 * level)));
    const uint32_t n = 1u << level;
    std::array<LatticePoint, 3> p{{{0, 0}, {n, 0}, {0, n}}};
    const auto midpoint = [](LatticePoint a, LatticePoint b) {
        return LatticePoint{(a.i + b.i) / 2, (a.j + b.j) / 2};
    };
    for (unsigned depth = level; depth-- > 0;) p = childCorners(p, (index >> (2 * depth)) & 3, midpoint);
    const uint32_t i = std::min({p[0].i, p[1].i, p[2].i});
    const uint32_t j = std::min({p[0].j, p[1].j, p[2].j});
    const bool upright = std::ranges::find(p, LatticePoint{i, j}) != p.end();
    return {i, j, !upright};
}

uint32_t barycentricsToIndex(float u, float v, unsigned level) {
    assert(level <= 15);
    const uint32_t n = 1u << level;
    const auto clamped = [](float x) { return x > 0 ? std::min(x, 1.0f) : 0.0f; };
    const float scaledU = clamped(u) * static_cast<float>(n);
    const float scaledV = clamped(v) * static_cast<float>(n);
    uint32_t iu = static_cast<uint32_t>(scaledU);
    uint32_t iv = static_cast<uint32_t>(scaledV);
    const float fractionU = scaledU - static_cast<float>(iu);
    const float fractionV = scaledV - static_cast<float>(iv);
    iu = std::min(iu, n - 1);
    iv = std::min(iv, n - 1);
    const uint32_t sum = iu + iv;
    if (sum >= n) iu -= sum - n + 1;
    uint32_t iw = ~(iu + iv);
    if (fractionU + fractionV >= 1.0f && sum < n - 1) --iw;
    return interleave(iu, iv, iw, level);
}

}  // namespace filigree::micromap
