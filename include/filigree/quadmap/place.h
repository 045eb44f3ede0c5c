// Where the two triangles of a pair lie in their square.
#pragma once

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

constexpr const std::array<uint8_t, 3>& verticesOf(SquarePlace place) {
    return squareOrders[place.order];
}
constexpr uint8_t orderOf(const std::array<uint8_t, 3>& vertices) {
    const auto found = std::find(squareOrders.begin(), squareOrders.end(), vertices);
    assert(found != squareOrders.end());
    return static_cast<uint8_t>(found - squareOrders.begin());
}

struct SquarePoint {
    float x = 0;  // 0..1
    float y = 0;
};

// The point with weights u and v of vertices 1 and 2.
constexpr SquarePoint pointInSquare(Half half, float u, float v) {
    return half == Half::first ? SquarePoint{u, v} : SquarePoint{1 - u, 1 - v};
}

// The column or row, of `side`, that holds coordinate `at`. Coordinates outside 0..1 and NaN count as the
// nearest inside; NaN as 0.
constexpr unsigned regionAlong(float at, unsigned side) {
    const float inside = std::min(at > 0 ? at : 0.0F, 1.0F);
    return std::min(static_cast<unsigned>(inside * static_cast<float>(side)), side - 1);
}

}  // namespace filigree::quadmap
