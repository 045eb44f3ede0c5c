#include "bake/majority.h"

#include "bake/rows.h"
#include "bake/votes.h"

#include <cmath>

namespace filigree::bake {
namespace {

constexpr unsigned leastDepth = 2;
constexpr unsigned mostDepth = 5;

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
        makeCentroids(2), makeCentroids(3), makeCentroids(4), makeCentroids(5)};
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
    const auto [minX, maxX] = std::ranges::minmax(offsetX_);
    const auto [minY, maxY] = std::ranges::minmax(offsetY_);
    rangeX_ = {minX, maxX};
    rangeY_ = {minY, maxY};
}

bool SideRule::isOpaque(micromap::LatticeTriangle t) const {
    const micromap::LatticePoint first = micromap::corners(t)[0];
    const Point<double> corner = part_->position(*placement_, first.i, first.j);
    const double sign = t.flipped ? -1 : 1;
    int64_t column = 0;
    int64_t row = 0;
    size_t opaque = 0;
    if (liesInside(corner, sign, column, row)) {
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

namespace {

// The cell at which samples from `corner` on start, where the image itself lies: true when no sample leaves
// it.
bool startsInside(double corner, const std::array<float, 2>& range, double sign, const image::CellAxis& axis,
                  int64_t& cell) {
    const int64_t unwrapped = floorToInt(corner);
    cell = axis.clamps() ? unwrapped : axis.canonical(unwrapped);
    const double inCell = corner - static_cast<double>(unwrapped);
    const double first = inCell + std::min(sign * double{range[0]}, sign * double{range[1]});
    const double last = inCell + std::max(sign * double{range[0]}, sign * double{range[1]});
    // A texel to spare for single precision.
    return cell + floorToInt(first) >= 1 && cell + floorToInt(last) + 2 < static_cast<int64_t>(axis.size);
}

}  // namespace

bool SideRule::liesInside(const Point<double>& corner, double sign, int64_t& column, int64_t& row) const {
    return outline_->filter() == image::Filter::linear &&
           outline_->texture().image.texels.size() < (size_t{1} << 30) &&
           startsInside(corner.x, rangeX_, sign, outline_->axisX(), column) &&
           startsInside(corner.y, rangeY_, sign, outline_->axisY(), row);
}

}  // namespace filigree::bake
