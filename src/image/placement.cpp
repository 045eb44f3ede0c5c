#include "filigree/image/placement.h"

#include <algorithm>
#include <cmath>

namespace filigree::image {
namespace {

// The multiple of an axis's period to take off so that `coordinate` lands in the first one.
double periodShift(double coordinate, const CellAxis& axis) {
    if (axis.wrap == Wrap::clampToEdge) return 0;
    const double period = static_cast<double>(axis.cells);
    return std::floor(coordinate / period) * period;
}

}  // namespace

Placement::Placement(const std::array<PatchPoint<Bounded>, 3>& texels, const CellAxis& axisX,
                     const CellAxis& axisY) {
    double lowX = texels[0].x.value();
    double lowY = texels[0].y.value();
    for (const PatchPoint<Bounded>& p : texels) {
        lowX = std::min(lowX, p.x.value());
        lowY = std::min(lowY, p.y.value());
    }
    // One number each, the same for all corners: whole periods and the half texel.
    const double shiftX = periodShift(lowX, axisX) + 0.5;
    const double shiftY = periodShift(lowY, axisY) + 0.5;
    double reach = 1;
    for (size_t k = 0; k < 3; ++k) {
        const Bounded x = texels[k].x - Bounded(shiftX);
        const Bounded y = texels[k].y - Bounded(shiftY);
        corners_[k] = {x, y};
        rounded_[k] = {x.value(), y.value()};
        reach = std::max({reach, std::fabs(x.value()), std::fabs(y.value())});
    }
    slack_ = reach * 4e-15;
}

PatchPoint<Bounded> Placement::boundedAt(int64_t i, int64_t j, unsigned level) const {
    const int64_t n = int64_t{1} << level;
    const Bounded weights[3] = {static_cast<double>(n - i - j), static_cast<double>(i),
                                static_cast<double>(j)};
    const Bounded scale = 1.0 / static_cast<double>(n);
    const auto mix = [&](const Bounded& a, const Bounded& b, const Bounded& c) {
        return (weights[0] * a + weights[1] * b + weights[2] * c) * scale;
    };
    return {mix(corners_[0].x, corners_[1].x, corners_[2].x),
            mix(corners_[0].y, corners_[1].y, corners_[2].y)};
}

}  // namespace filigree::image
