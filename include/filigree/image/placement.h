// Where the lattice points of a triangle lie in the sample space of a texture.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/bounded.h"
#include "filigree/image/outline.h"
#include "filigree/image/patch.h"

#include <array>
#include <cmath>
#include <cstdint>

namespace filigree::image {

// A triangle in the sample space of one texture (texel space minus a half), moved by whole periods of the
// wrap modes to lie near the origin, which changes nothing. Lattice points are taken straight from the
// corners, with integer weights, so that depth adds no error.
class FILIGREE_API Placement {
  public:
    // Corners in texel space, within maxTexels of the origin.
    Placement(const std::array<PatchPoint<Bounded>, 3>& texels, const CellAxis& axisX, const CellAxis& axisY);

    static constexpr double maxTexels = 67108864.0;  // 2^26

    // The lattice point (i, j) of the lattice with n = 2^level steps, in double: off by at most slack() where
    // it lies in the triangle.
    [[nodiscard]] PatchPoint<double> at(int64_t i, int64_t j, unsigned level) const {
        const double scale = 1.0 / static_cast<double>(int64_t{1} << level);
        const double di = static_cast<double>(i) * scale;
        const double dj = static_cast<double>(j) * scale;
        return {
            rounded_[0].x + (di * (rounded_[1].x - rounded_[0].x) + dj * (rounded_[2].x - rounded_[0].x)),
            rounded_[0].y + (di * (rounded_[1].y - rounded_[0].y) + dj * (rounded_[2].y - rounded_[0].y))};
    }

    // The same with a proven error bound, 0 where nothing was rounded.
    [[nodiscard]] PatchPoint<Bounded> boundedAt(int64_t i, int64_t j, unsigned level) const;

    // Bounds the error of at(), in texels.
    [[nodiscard]] double slack() const { return slack_; }

  private:
    std::array<PatchPoint<Bounded>, 3> corners_;
    std::array<PatchPoint<double>, 3> rounded_;
    double slack_ = 0;
};

// The point of texel space that texture coordinates address on a texture of those axes.
inline PatchPoint<Bounded> texelPoint(float u, float v, const CellAxis& axisX, const CellAxis& axisY) {
    return {Bounded(u) * Bounded(axisX.size), Bounded(v) * Bounded(axisY.size)};
}

// True when texture coordinates are finite and near enough to be placed on a texture of that size.
inline bool isPlaceable(float u, float v, uint32_t width, uint32_t height) {
    return std::fabs(double{u} * width) <= Placement::maxTexels &&
           std::fabs(double{v} * height) <= Placement::maxTexels;
}

}  // namespace filigree::image
