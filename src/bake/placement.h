// Where the lattice points of a UV triangle lie in the sample space of a texture.
#pragma once

#include "filigree/image/outline.h"
#include "filigree/image/placement.h"
#include "filigree/mesh/uv_triangle.h"

#include <cstdint>

namespace filigree::bake {

template <class Real>
using Point = image::PatchPoint<Real>;

class Placement : public image::Placement {
  public:
    // UVs must be finite and within maxTexels of the origin in texels.
    Placement(const mesh::UvTriangle& triangle, const image::CellAxis& axisX, const image::CellAxis& axisY)
        : image::Placement({image::texelPoint(triangle.uv[0].u, triangle.uv[0].v, axisX, axisY),
                            image::texelPoint(triangle.uv[1].u, triangle.uv[1].v, axisX, axisY),
                            image::texelPoint(triangle.uv[2].u, triangle.uv[2].v, axisX, axisY)},
                           axisX, axisY) {}
    Placement(const mesh::UvTriangle& triangle, const image::Outline& outline)
        : Placement(triangle, outline.axisX(), outline.axisY()) {}
};

// True when a triangle can be placed on a texture of that size; false where a coordinate or vertex alpha is
// not finite or out of reach.
bool isPlaceable(const mesh::UvTriangle& triangle, uint32_t width, uint32_t height);

}  // namespace filigree::bake
