// Where the two triangles of a pair lie in their square.
#pragma once

#include <algorithm>

namespace filigree::quadmap {

// Both triangles run the same way round, and share the edge between their vertices 1 and 2:
//   first   vertex 0 top left (0, 0),     vertex 1 top right (1, 0),   vertex 2 bottom left (0, 1)
//   second  vertex 0 bottom right (1, 1), vertex 1 bottom left (0, 1), vertex 2 top right (1, 0)
// x runs to the right and y down, so row 0 of a Square lies at the top.
enum class Half : unsigned char { first = 0, second = 1 };

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
