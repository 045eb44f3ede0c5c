#include "bake/crossing.h"

#include <algorithm>

namespace filigree::bake {
namespace {

std::array<Point<double>, 3> firstMicroTriangle(const SubTriangle& part, const Placement& placement) {
    return {part.position(placement, 0, 0), part.position(placement, 1, 0), part.position(placement, 0, 1)};
}

}  // namespace

CrossingTest::CrossingTest(const SubTriangle& part, const Placement& placement, const image::Outline& outline,
                           double guard)
    : part_(&part),
      placement_(&placement),
      filter_(outline.filter()),
      shape_(firstMicroTriangle(part, placement), guard) {}

template <class Real>
bool CrossingTest::touches(micromap::LatticeTriangle t, int64_t cellX, int64_t cellY,
                           const image::OutlinePiece& piece, double slack) const {
    const auto polygon = shape_.polygon<Real>(*part_, *placement_, t, cellX, cellY);
    const auto [x0, x1] = std::minmax(piece.x0, piece.x1);
    const auto [y0, y1] = std::minmax(piece.y0, piece.y1);
    return image::clipped(polygon, x0, x1, y0, y1, slack).size() > 0;
}

bool CrossingTest::crosses(micromap::LatticeTriangle t, int64_t cellX, int64_t cellY,
                           const image::Patch& patch, const image::OutlinePiece& piece) const {
    const double slack = placement_->slack();
    if (filter_ == image::Filter::nearest) {
        return touches<double>(t, cellX, cellY, piece, slack) && touches<Bounded>(t, cellX, cellY, piece, 0);
    }
    const auto polygon = shape_.polygon<double>(*part_, *placement_, t, cellX, cellY);
    const image::PatchRange rough = image::rangeOver(patch, polygon, slack);
    const double tolerance = image::patchTolerance(patch, slack);
    if (rough.empty() || rough.isOpaque(tolerance) || rough.isTransparent(tolerance)) return false;
    if (rough.lower < -tolerance && rough.upper > tolerance) return true;
    // Too close to call in double.
    const auto exact = shape_.polygon<Bounded>(*part_, *placement_, t, cellX, cellY);
    const image::PatchRange range = image::rangeOver(patch, exact);
    return !(range.empty() || range.isOpaque() || range.isTransparent());
}

}  // namespace filigree::bake
