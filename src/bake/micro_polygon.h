// The widened outline of a micro-triangle: the corners of the triangle plus the guard square.
#pragma once

#include "filigree/image/widened.h"

#include "bake/tile.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace filigree::bake {

// The hull of a triangle and the square [-guard, guard]^2 moved to its corners, as a list of corner numbers
// with offsets. All micro-triangles of a sub-triangle share it; flipped ones take the offsets negated.
class WidenedShape {
  public:
    WidenedShape(const std::array<Point<double>, 3>& corners, double guard);

    // The polygon of micro-triangle `t` of `part`, relative to the cell (cellX, cellY).
    template <class Real>
    [[nodiscard]] image::PatchPolygon<Real> polygon(const SubTriangle& part, const Placement& placement,
                                                    micromap::LatticeTriangle t, int64_t cellX,
                                                    int64_t cellY) const {
        std::array<Point<Real>, 3> corner;
        const auto lattice = micromap::corners(t);
        for (size_t k = 0; k < 3; ++k) corner[k] = position<Real>(part, placement, lattice[k]);
        const double sign = t.flipped ? -1 : 1;
        image::PatchPolygon<Real> polygon;
        for (const image::WidenedCorner& c : std::span(shape_).first(size_)) {
            const Point<Real>& p = corner[c.corner];
            polygon.push({p.x - Real(static_cast<double>(cellX)) + Real(sign * c.x),
                          p.y - Real(static_cast<double>(cellY)) + Real(sign * c.y)});
        }
        return polygon;
    }

  private:
    template <class Real>
    static Point<Real> position(const SubTriangle& part, const Placement& placement,
                                micromap::LatticePoint p) {
        if constexpr (std::is_same_v<Real, double>) {
            return part.position(placement, p.i, p.j);
        } else {
            return part.boundedPosition(placement, p.i, p.j);
        }
    }

    std::array<image::WidenedCorner, 12> shape_{};
    size_t size_ = 0;
};

}  // namespace filigree::bake
