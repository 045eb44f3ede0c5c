// The order of micro-triangles: the space-filling curve of VK_KHR_opacity_micromap ("bird curve").
#pragma once

#include "filigree/core/api.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>

namespace filigree::micromap {

// A point of the lattice that a level lays over a triangle: vertex0 + i/n (vertex1 - vertex0) + j/n (vertex2
// - vertex0) with n = 2^level and 0 <= i + j <= n.
struct LatticePoint {
    uint32_t i = 0;
    uint32_t j = 0;
    bool operator==(const LatticePoint&) const = default;
};

// One micro-triangle by its place in the lattice. Upright ones have the corners (i, j), (i+1, j), (i, j+1);
// the others, `flipped`, have (i+1, j+1), (i, j+1), (i+1, j).
struct LatticeTriangle {
    uint32_t i = 0;
    uint32_t j = 0;
    bool flipped = false;
    bool operator==(const LatticeTriangle&) const = default;
};

constexpr std::array<LatticePoint, 3> corners(LatticeTriangle t) {
    if (t.flipped) return {{{t.i + 1, t.j + 1}, {t.i, t.j + 1}, {t.i + 1, t.j}}};
    return {{{t.i, t.j}, {t.i + 1, t.j}, {t.i, t.j + 1}}};
}

// Curve index of a micro-triangle at `level`, 0..15. The triangle must lie in the lattice.
FILIGREE_API uint32_t curveIndex(LatticeTriangle triangle, unsigned level);

// Integer coordinates of a micro-triangle as the reference function of VK_KHR_opacity_micromap takes them:
// the barycentrics times 2^level, rounded down; the low `level` bits of `w` make u + v + w = -1, or -2 where
// the triangle is flipped.
struct CurveCoordinates {
    uint32_t u = 0;
    uint32_t v = 0;
    uint32_t w = 0;
};

// Those of the micro-triangle that holds the point with barycentrics (u, v), the weights of vertices 1 and 2;
// coordinates outside the triangle are clamped, NaN counts as 0. As the reference function in single
// precision, ties included. level 0..15.
inline CurveCoordinates curveCoordinates(float u, float v, unsigned level) {
    const uint32_t n = 1u << level;
    const auto clamped = [](float x) { return x > 0 ? std::min(x, 1.0f) : 0.0f; };
    const float scaledU = clamped(u) * static_cast<float>(n);
    const float scaledV = clamped(v) * static_cast<float>(n);
    const auto floorU = static_cast<int32_t>(scaledU);
    const auto floorV = static_cast<int32_t>(scaledV);
    const float fractions = (scaledU - static_cast<float>(floorU)) + (scaledV - static_cast<float>(floorV));
    uint32_t iu = std::min(static_cast<uint32_t>(floorU), n - 1);
    const uint32_t iv = std::min(static_cast<uint32_t>(floorV), n - 1);
    const uint32_t sum = iu + iv;
    if (sum >= n) iu -= sum - n + 1;
    const uint32_t flipped = fractions >= 1.0f && sum < n - 1 ? 1 : 0;
    return {iu, iv, ~(iu + iv) - flipped};
}

namespace detail {

// Each byte with its bits spread to the even places.
inline constexpr std::array<uint16_t, 256> spreadBytes = [] {
    std::array<uint16_t, 256> spreads{};
    for (unsigned k = 0; k < 256; ++k) {
        for (unsigned bit = 0; bit < 8; ++bit)
            spreads[k] = static_cast<uint16_t>(spreads[k] | (k >> bit & 1) << (2 * bit));
    }
    return spreads;
}();

// Spreads the low 16 bits of `bits` to the even places.
constexpr uint32_t spread(uint32_t bits) {
    return spreadBytes[bits & 255] | uint32_t{spreadBytes[bits >> 8 & 255]} << 16;
}

// The way back: the even places of `bits`, gathered.
constexpr uint32_t gather(uint32_t bits) {
    bits &= 0x55555555u;
    bits = (bits | (bits >> 1)) & 0x33333333u;
    bits = (bits | (bits >> 2)) & 0x0f0f0f0fu;
    bits = (bits | (bits >> 4)) & 0x00ff00ffu;
    return (bits | (bits >> 8)) & 0x0000ffffu;
}

// Each bit becomes the parity of itself and all higher ones, in the low 16 bits.
constexpr uint32_t prefixParity(uint32_t bits) {
    bits ^= bits >> 1;
    bits ^= bits >> 2;
    bits ^= bits >> 4;
    return bits ^ (bits >> 8);
}

}  // namespace detail

// The micro-triangle at curve index `index` < 4^level, level 0..15; all levels at once. Children 1 and 3 swap
// the first two vertices of what is below them, and the middle child, 1, also turns it upside down, which
// complements the bits of both coordinates.
constexpr LatticeTriangle latticeTriangle(uint32_t index, [[maybe_unused]] unsigned level) {
    assert(level <= 15 && index < (uint64_t{1} << (2 * level)));
    const uint32_t low = detail::gather(index);
    const uint32_t high = detail::gather(index >> 1);
    const uint32_t turns = detail::prefixParity(low & ~high);
    const uint32_t swaps = detail::prefixParity(low) >> 1;
    return {(~low & (high ^ swaps)) ^ (turns >> 1), (low & high) ^ (turns >> 1), (turns & 1) != 0};
}

// Curve index of a micro-triangle: the interleaving step of the reference function. level 0..15.
constexpr uint32_t curveIndexOf(CurveCoordinates at, unsigned level) {
    const uint32_t mask = (1u << level) - 1;
    const uint32_t low = ~(at.u ^ at.w) & mask;
    const uint32_t tie = (at.u ^ at.v) & low;
    const uint32_t high = ((detail::prefixParity(tie) ^ at.u) & ~low & mask) | tie;
    return detail::spread(low) | (detail::spread(high) << 1);
}

// Curve index of the micro-triangle that holds a point: the number that the reference function gives.
inline uint32_t barycentricsToIndex(float u, float v, unsigned level) {
    return curveIndexOf(curveCoordinates(u, v, level), level);
}

// The corners of child 0..3 of a triangle (a, b, c), in the order that makes the child's own curve run on:
// child 0 lies at a, 1 is the middle, 2 lies at b, 3 at c. `midpoint(p, q)` gives the point halfway.
template <class Point, class Midpoint>
constexpr std::array<Point, 3> childCorners(const std::array<Point, 3>& p, unsigned child,
                                            Midpoint midpoint) {
    const Point ab = midpoint(p[0], p[1]);
    const Point bc = midpoint(p[1], p[2]);
    const Point ca = midpoint(p[2], p[0]);
    switch (child) {
        case 0:
            return {p[0], ab, ca};
        case 1:
            return {ca, bc, ab};
        case 2:
            return {ab, p[1], bc};
        default:
            return {bc, ca, p[2]};
    }
}

}  // namespace filigree::micromap
