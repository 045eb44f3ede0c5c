// Where the lattice points of a triangle lie in the sample space of a texture.
#pragma once

#include "filigree/core/bounded.h"
#include "filigree/image/outline.h"
#include "filigree/mesh/uv_triangle.h"

#include <array>
#include <cstdint>

namespace filigree::bake {

template <class Real>
using Point = image::PatchPoint<Real>;

// A UV triangle in the sample space of one texture (texel space minus a half), moved by whole periods of the
// wrap modes to lie near the origin, which changes nothing. Lattice points are taken straight from the
// corners, with integer weights, so that depth adds no error.
class Placement {
  public:
    // UVs must be finite and within maxTexels of the origin in texels.
    Placement(const mesh::UvTriangle& triangle, const image::CellAxis& axisX, const image::CellAxis& axisY);
    Placement(const mesh::UvTriangle& triangle, const image::Outline& outline)
        : Placement(triangle, outline.axisX(), outline.axisY()) {}

    static constexpr double maxTexels = 67108864.0;  // 2^26

    // The lattice point (i, j) of the lattice with n = 2^level steps, in double: off by at most slack().
    [[nodiscard]] Point<double> at(int64_t i, int64_t j, unsigned level) const {
        const double scale = 1.0 / static_cast<double>(int64_t{1} << level);
        const double di = static_cast<double>(i) * scale;
        const double dj = static_cast<double>(j) * scale;
        return {
            rounded_[0].x + (di * (rounded_[1].x - rounded_[0].x) + dj * (rounded_[2].x - rounded_[0].x)),
            rounded_[0].y + (di * (rounded_[1].y - rounded_[0].y) + dj * (rounded_[2].y - rounded_[0].y))};
    }

    // The same with a proven error bound, 0 where nothing was rounded.
    [[nodiscard]] Point<Bounded> boundedAt(int64_t i, int64_t j, unsigned level) const;

    // Bounds the error of at(), in texels.
    [[nodiscard]] double slack() const { return slack_; }

  private:
    std::array<Point<Bounded>, 3> corners_;
    std::array<Point<double>, 3> rounded_;
    double slack_ = 0;
};

// True when a triangle can be placed on a texture of that size; false where a coordinate or vertex alpha is
// not finite or out of reach.
bool isPlaceable(const mesh::UvTriangle& triangle, uint32_t width, uint32_t height);

}  // namespace filigree::bake
