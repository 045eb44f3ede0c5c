#include "bake/placement.h"

#include <algorithm>
#include <cmath>

namespace filigree::bake {
namespace {

// The multiple of an axis's period to take off so that `coordinate` lands in the first one.
double periodShift(double coordinate, const image::CellAxis& axis) {
    if (axis.wrap == image::Wrap::clampToEdge) return 0;
    const double period = static_cast<double>(axis.cells);
    return std::floor(coordinate / period) * period;
}

}  // namespace

Placement::Placement(const mesh::UvTriangle& triangle, const image::CellAxis& axisX,
                     const image::CellAxis& axisY) {
    const double width = axisX.size;
    const double height = axisY.size;
    double lowU = triangle.uv[0].u;
    double lowV = triangle.uv[0].v;
    for (const mesh::Uv& uv : triangle.uv) {
        lowU = std::min<double>(lowU, uv.u);
        lowV = std::min<double>(lowV, uv.v);
    }
    // One number each, the same for all corners: whole periods and the half texel.
    const double shiftX = periodShift(lowU * width, axisX) + 0.5;
    const double shiftY = periodShift(lowV * height, axisY) + 0.5;
    double reach = 1;
    for (size_t k = 0; k < 3; ++k) {
        const Bounded x = Bounded(triangle.uv[k].u) * Bounded(width) - Bounded(shiftX);
        const Bounded y = Bounded(triangle.uv[k].v) * Bounded(height) - Bounded(shiftY);
        corners_[k] = {x, y};
        rounded_[k] = {x.value(), y.value()};
        reach = std::max({reach, std::fabs(x.value()), std::fabs(y.value())});
    }
    slack_ = reach * 4e-15;
}

Point<Bounded> Placement::boundedAt(int64_t i, int64_t j, unsigned level) const {
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

bool isPlaceable(const mesh::UvTriangle& triangle, uint32_t width, uint32_t height) {
    for (const float alpha : triangle.alpha) {
        if (!std::isfinite(alpha)) return false;
    }
    return std::ranges::all_of(triangle.uv, [&](const mesh::Uv& uv) {
        return std::fabs(double{uv.u} * width) <= Placement::maxTexels &&
               std::fabs(double{uv.v} * height) <= Placement::maxTexels;
    });
}

}  // namespace filigree::bake
