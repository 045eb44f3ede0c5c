#include "bake/majority.h"

#include "bake/rows.h"
#include "bake/votes.h"

#include <cmath>

namespace filigree::bake {
namespace {

constexpr unsigned leastDepth = 2;
constexpr unsigned mostDepth = 6;

std::vector<SideRule::Centroid> makeCentroids(unsigned levels) {
    std::vector<SideRule::Centroid> centroids;
    const double third = 1.0 / (3.0 * static_cast<double>(1u << levels));
    for (uint32_t k = 0; k < micromap::microTriangleCount(levels); ++k) {
        SideRule::Centroid sum;
        for (const micromap::LatticePoint c : micromap::corners(micromap::latticeTriangle(k, levels))) {
            sum.i += c.i * third;
            sum.j += c.j * third;
        }
        centroids.push_back(sum);
    }
    return centroids;
}

}  // namespace

const std::vector<SideRule::Centroid>& SideRule::centroids(unsigned depth) {
    static const std::array<std::vector<Centroid>, mostDepth - leastDepth + 1> all{
        makeCentroids(2), makeCentroids(3), makeCentroids(4), makeCentroids(5), makeCentroids(6)};
    return all[depth - leastDepth];
}

unsigned SideRule::depth(double squareTexels) {
    unsigned depth = leastDepth;
    while (depth < mostDepth && squareTexels > 4.0 * static_cast<double>(1u << (2 * depth))) ++depth;
    return depth;
}

SideRule::SideRule(const SubTriangle& part, const Placement& placement, const image::Outline& outline)
    : part_(&part), placement_(&placement), outline_(&outline) {
    const Point<double> origin = part.position(placement, 0, 0);
    const Point<double> p = part.position(placement, 1, 0);
    const Point<double> q = part.position(placement, 0, 1);
    const double ux = p.x - origin.x;
    const double uy = p.y - origin.y;
    const double vx = q.x - origin.x;
    const double vy = q.y - origin.y;
    const unsigned levels = depth(std::fabs(ux * vy - uy * vx) / 2);
    const std::vector<Centroid>& all = centroids(levels);
    offsetX_.reserve(all.size());
    offsetY_.reserve(all.size());
    for (const Centroid& c : all) {
        offsetX_.push_back(static_cast<float>(c.i * ux + c.j * vx));
        offsetY_.push_back(static_cast<float>(c.i * uy + c.j * vy));
    }
    reach_ = std::max({std::fabs(ux), std::fabs(uy), std::fabs(vx), std::fabs(vy)});
}

bool SideRule::isOpaque(micromap::LatticeTriangle t) const {
    const micromap::LatticePoint first = micromap::corners(t)[0];
    const Point<double> corner = part_->position(*placement_, first.i, first.j);
    const double sign = t.flipped ? -1 : 1;
    int64_t column = 0;
    int64_t row = 0;
    size_t opaque = 0;
    if (liesInside(corner, column, row)) {
        const Votes votes{&outline_->texture().image,
                          static_cast<uint32_t>(column),
                          static_cast<uint32_t>(row),
                          static_cast<float>(corner.x - std::floor(corner.x)),
                          static_cast<float>(corner.y - std::floor(corner.y)),
                          static_cast<float>(sign),
                          static_cast<float>(outline_->threshold().value)};
        opaque = countOpaque(votes, offsetX_, offsetY_);
    } else {
        for (size_t k = 0; k < offsetX_.size(); ++k) {
            const double x = corner.x + sign * double{offsetX_[k]};
            const double y = corner.y + sign * double{offsetY_[k]};
            opaque += outline_->sideAt(x, y).opaque ? 1 : 0;
        }
    }
    return 2 * opaque >= offsetX_.size();
}

bool SideRule::liesInside(const Point<double>& corner, int64_t& column, int64_t& row) const {
    if (outline_->filter() != image::Filter::linear) return false;
    const image::Outline::Axis& x = outline_->axisX();
    const image::Outline::Axis& y = outline_->axisY();
    // The cell of the corner where the image itself lies; samples reach `margin` cells around it.
    column = floorToInt(corner.x);
    row = floorToInt(corner.y);
    if (x.wrap != image::Wrap::clampToEdge) column = x.canonical(column);
    if (y.wrap != image::Wrap::clampToEdge) row = y.canonical(row);
    const auto margin = static_cast<int64_t>(2 * reach_) + 2;
    return column >= margin && column + margin < static_cast<int64_t>(x.size) && row >= margin &&
           row + margin < static_cast<int64_t>(y.size) &&
           outline_->texture().image.texels.size() < (size_t{1} << 30);
}

}  // namespace filigree::bake
