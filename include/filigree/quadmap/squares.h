// From alpha textures to three-state squares: what is known of each region, for certain.
#pragma once

#include "filigree/core/api.h"
#include "filigree/image/alpha_image.h"
#include "filigree/mesh/uv_triangle.h"
#include "filigree/quadmap/place.h"
#include "filigree/quadmap/square.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace filigree::quadmap {

// The largest side of a square that is made from a texture.
inline constexpr unsigned maxSquareSide = 64;

// A rectangle of texels, [x0, x1) x [y0, y1).
struct Crop {
    uint32_t x0 = 0;
    uint32_t y0 = 0;
    uint32_t x1 = 0;
    uint32_t y1 = 0;
    bool operator==(const Crop&) const = default;
};

// The smallest rectangle that holds every texel of alpha above 0, none where there is none.
FILIGREE_API std::optional<Crop> visibleCrop(const image::AlphaImage& image);

// A triangle as one half of a square, its vertices as place.h wants them: vertex 0 opposite the shared edge.
using HalfTriangle = mesh::UvTriangle;

// Makes squares over one texture under one alpha test. A region is known only where every point of it,
// widened by the test's guard, is certainly on one side, at every filter and mip level asked for
// (docs/spec/bake.md); exact for a constant vertex alpha, bounded for a varying one. Calls may come from
// several threads at once.
class FILIGREE_API SquareMaker {
  public:
    // `texture` must outlive it. `test` must hold finite numbers >= 0.
    SquareMaker(const image::AlphaTexture& texture, const image::AlphaTest& test);
    ~SquareMaker();
    SquareMaker(const SquareMaker&) = delete;
    SquareMaker& operator=(const SquareMaker&) = delete;

    // `crop`, not empty and within the image, as one square, row 0 at the least v. `side` must be a power of
    // two up to maxSquareSide. Points at the crop's border read the texels beyond it, or what the wrap mode
    // says.
    [[nodiscard]] Square ofCrop(const Crop& crop, unsigned side) const;
    [[nodiscard]] Square ofTexture(unsigned side) const;

    // A pair of triangles: each half follows its own triangle. Regions on the diagonal are known where both
    // halves of them agree. Triangles that are not finite or out of reach are mixed.
    [[nodiscard]] Square ofPair(const HalfTriangle& first, const HalfTriangle& second, unsigned side) const;

    // A triangle without a partner: the regions of the second half are free.
    [[nodiscard]] Square ofSingle(const HalfTriangle& first, unsigned side) const;

  private:
    std::unique_ptr<const class SquareField> field_;
};

// The same square with half the side, which must be even. Known regions are those of which all four parts are
// free or alike; so it is the square that SquareMaker makes with half the side.
FILIGREE_API Square halved(const Square& square);

}  // namespace filigree::quadmap
