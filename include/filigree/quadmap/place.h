// Where the two triangles of a pair lie in their square.
#pragma once

#include "filigree/quadmap/transform.h"

#include "filigree_lookup.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>

namespace filigree::quadmap {

// Both triangles run the same way round, and share the edge between their vertices 1 and 2:
//   first   vertex 0 top left (0, 0),     vertex 1 top right (1, 0),   vertex 2 bottom left (0, 1)
//   second  vertex 0 bottom right (1, 1), vertex 1 bottom left (0, 1), vertex 2 top right (1, 0)
// x runs to the right and y down, so row 0 of a Square lies at the top.
enum class Half : unsigned char { first = 0, second = 1 };

// Where a triangle stands in its square.
struct SquarePlace {
    Half half = Half::first;
    uint8_t order = 0;  // into squareOrders
    bool operator==(const SquarePlace&) const = default;
};

// Which of a triangle's vertices stand as vertices 0, 1 and 2 of its half: turned, and turned over.
inline constexpr std::array<std::array<uint8_t, 3>, 6> squareOrders{
    {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {1, 0, 2}, {2, 1, 0}}};

// The way from a place to its order of vertices, and back.
constexpr const std::array<uint8_t, 3>& verticesOf(SquarePlace place) {
    return squareOrders[place.order];
}
constexpr uint8_t orderOf(const std::array<uint8_t, 3>& vertices) {
    const auto found = std::find(squareOrders.begin(), squareOrders.end(), vertices);
    assert(found != squareOrders.end());
    return static_cast<uint8_t>(found - squareOrders.begin());
}

// A point of the unit square.
struct SquarePoint {
    float x = 0;  // 0..1
    float y = 0;
};

// The point with weights u and v of vertices 1 and 2.
constexpr SquarePoint pointInSquare(Half half, float u, float v) {
    const filigree_square_point point = filigree_point_in_square(static_cast<unsigned>(half), u, v);
    return {point.x, point.y};
}

// The column or row, of `side`, that holds coordinate `at`. Coordinates outside 0..1 and NaN count as the
// nearest inside; NaN as 0.
constexpr unsigned regionAlong(float at, unsigned side) {
    return filigree_region_along(at, side);
}

// Weights of vertices 1 and 2 of a half.
struct HalfWeights {
    double u = 0;
    double v = 0;
};

// Those of the half that a triangle stands in, from the weights u and v of the triangle's own vertices 1 and
// 2. In double precision the point stays within its region.
constexpr HalfWeights weightsIn(SquarePlace place, float u, float v) {
    const std::array<double, 3> weights{1 - double{u} - double{v}, double{u}, double{v}};
    const auto& vertices = verticesOf(place);
    return {weights[vertices[1]], weights[vertices[2]]};
}

namespace detail {

constexpr unsigned regionInside(double at, unsigned side) {
    const double inside = at > 0 ? at * side : 0.0;
    return inside < side ? static_cast<unsigned>(inside) : side - 1;
}

}  // namespace detail

// The region, of side x side, that holds the point with weights u and v of a triangle's own vertices 1 and 2.
// The point of the shared edge where four regions meet belongs to none of those that lie in the other half
// alone.
constexpr Cell regionOf(SquarePlace place, float u, float v, unsigned side) {
    const HalfWeights at = weightsIn(place, u, v);
    const bool isFirst = place.half == Half::first;
    const unsigned x = detail::regionInside(isFirst ? at.u : 1 - at.u, side);
    const unsigned y = detail::regionInside(isFirst ? at.v : 1 - at.v, side);
    const unsigned onEdge = side - 1 - y;
    return {isFirst ? std::min(x, onEdge) : std::max(x, onEdge), y};
}

}  // namespace filigree::quadmap
