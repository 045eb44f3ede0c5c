// A frame in which the six symmetries of the triangle act alike on every level of subdivision.
#pragma once

#include "filigree/micromap/curve.h"

#include <array>
#include <cstdint>

namespace filigree::micromap {

// Where a micro-triangle lies: the digit of each level is two bits, bit k of `a` and bit k of `b` for the
// level of children that are 2^k micro-triangle edges long. Digit (a, b) = (0, 0) is the middle child, (1, 0)
// the one at vertex 1, (0, 1) at vertex 2, (1, 1) at vertex 0. A middle child counts the midpoints opposite
// of vertices 0, 1, 2 as its own vertices 0, 1, 2; so the parent's symmetries are the child's. Digits are the
// exclusive ors of the bits of the integer coordinates: no prefix sums, no interleaving.
struct Planes {
    uint32_t a = 0;
    uint32_t b = 0;
    bool operator==(const Planes&) const = default;
};

// The planes of a place.
constexpr Planes planesOf(CurveCoordinates at, unsigned level) {
    const filigree_planes planes = filigree_planes_of(at, level);
    return {planes.a, planes.b};
}

// The planes of curve index `index` < 4^level, level 0..15.
constexpr Planes planesOfIndex(uint32_t index, unsigned level) {
    const filigree_planes planes = filigree_planes_of_index(index, level);
    return {planes.a, planes.b};
}

// The way back.
constexpr uint32_t indexOfPlanes(Planes p, unsigned level) {
    return filigree_index_of_planes({p.a, p.b}, level);
}

// The digit (2 a + b) of child 0..3 of the curve, below a node with an even or odd number of children 1 and 3
// on the way to it.
constexpr unsigned digitOfChild(unsigned child, bool odd) {
    constexpr std::array<std::array<uint8_t, 4>, 2> digits{{{3, 0, 2, 1}, {2, 0, 3, 1}}};
    return digits[odd ? 1 : 0][child];
}

// The symmetries permute the digits 1, 2, 3 and leave the middle child; they are the invertible linear maps
// of (a, b) over GF(2). Symmetry 0 is the identity.
inline constexpr unsigned symmetryCount = 6;

// Four bits each, the lowest symmetry 0: m0..m3 of the map a' = m0 a ^ m1 b, b' = m2 a ^ m3 b.
inline constexpr uint32_t symmetryMatrices = FILIGREE_SYMMETRY_MATRICES;

// The place that has them after a symmetry.
constexpr Planes turned(Planes p, unsigned symmetry) {
    const filigree_planes planes = filigree_planes_turned({p.a, p.b}, symmetry);
    return {planes.a, planes.b};
}

// What `symmetry` makes of one digit.
constexpr unsigned turnedDigit(unsigned digit, unsigned symmetry) {
    const Planes t = turned({digit >> 1, digit & 1}, symmetry);
    return 2 * t.a + t.b;
}

}  // namespace filigree::micromap
