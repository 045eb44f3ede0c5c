// Regular spacings that the vertices of a mesh lie on.
#pragma once

#include "filigree/grid/vertex_grid.h"

#include <cstddef>
#include <optional>

namespace filigree::grid {

// What is known of the coordinates on one axis, all of them finite.
struct AxisCoordinates {
    double low = 0;
    double high = 0;

    // What floats of this size cannot hold: 2^-22 of the greatest.
    [[nodiscard]] double rounding() const;
};

// Calls use(value, index) for the coordinates of all vertices, grids first, then loose ones, until it returns
// false. Returns whether it never did.
template <class Use>
bool forEachCoordinate(const GridMesh& mesh, size_t axis, const Use& use) {
    size_t index = 0;
    for (const Vec3& vertex : mesh.vertices)
        if (!use(double{vertex[axis]}, index++)) return false;
    for (const Vec3& vertex : mesh.looseVertices)
        if (!use(double{vertex[axis]}, index++)) return false;
    return true;
}

// All coordinates are origin + step * n, n a whole number in [0, 2^24).
struct AxisSpacing {
    double origin = 0;
    double step = 1;
    bool exact = false;  // to the bit when rounded to float, else up to rounding()
    bool even = false;   // along rows and columns of every grid n grows evenly
};
struct SpacingSearch {
    std::optional<AxisSpacing> spacing;  // the greatest one, exact where that can be found
    std::optional<size_t> breach;        // a vertex that the spacing of those before it does not hold
};
// Nothing where all coordinates are equal.
SpacingSearch findSpacing(const GridMesh& mesh, size_t axis, const AxisCoordinates& coordinates);

// The greatest power of two that is exact, none where it needs 2^24 coordinates.
std::optional<double> dyadicSpacingOf(const GridMesh& mesh, size_t axis, const AxisCoordinates& coordinates);

}  // namespace filigree::grid
