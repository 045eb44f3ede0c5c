// The order of micro-triangles: the space-filling curve of VK_KHR_opacity_micromap ("bird curve").
#pragma once

#include "filigree/core/api.h"

#include "filigree_lookup.h"

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

// The corners in the order of the triangle's vertices.
constexpr std::array<LatticePoint, 3> corners(LatticeTriangle t) {
    if (t.flipped) return {{{t.i + 1, t.j + 1}, {t.i, t.j + 1}, {t.i + 1, t.j}}};
    return {{{t.i, t.j}, {t.i + 1, t.j}, {t.i, t.j + 1}}};
}

// Curve index of a micro-triangle at `level`, 0..15. The triangle must lie in the lattice.
FILIGREE_API uint32_t curveIndex(LatticeTriangle triangle, unsigned level);

// Integer coordinates of a micro-triangle as the reference function of VK_KHR_opacity_micromap takes them:
// the barycentrics times 2^level, rounded down; the low `level` bits of `w` make u + v + w = -1, or -2 where
// the triangle is flipped.
using CurveCoordinates = filigree_curve_coordinates;

// Those of the micro-triangle that holds the point with barycentrics (u, v), the weights of vertices 1 and 2;
// coordinates outside the triangle are clamped, NaN counts as 0. As the reference function in single
// precision, ties included. level 0..15.
inline CurveCoordinates curveCoordinates(float u, float v, unsigned level) {
    return filigree_curve_coordinates_at(u, v, level);
}

// The micro-triangle at curve index `index` < 4^level, level 0..15; all levels at once. Children 1 and 3 swap
// the first two vertices of what is below them, and the middle child, 1, also turns it upside down, which
// complements the bits of both coordinates.
constexpr LatticeTriangle latticeTriangle(uint32_t index, [[maybe_unused]] unsigned level) {
    assert(level <= 15 && index < (uint64_t{1} << (2 * level)));
    const filigree_lattice_triangle found = filigree_lattice_triangle_at(index);
    return {found.i, found.j, found.flipped != 0};
}

// Curve index of a micro-triangle: the interleaving step of the reference function. level 0..15.
constexpr uint32_t curveIndexOf(CurveCoordinates at, unsigned level) {
    return filigree_curve_index_of(at, level);
}

// Curve index of the micro-triangle that holds a point: the number that the reference function gives.
inline uint32_t barycentricsToIndex(float u, float v, unsigned level) {
    return filigree_curve_index_at(u, v, level);
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
