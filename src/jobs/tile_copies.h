// Where triangles lie in a texture: parts beyond it come back into it as its wrap modes say.
#pragma once

#include "filigree/image/alpha_image.h"
#include "filigree/mesh/uv_triangle.h"

#include "jobs/canvas.h"

#include <array>
#include <cstdint>
#include <vector>

namespace filigree::jobs {

// The corners of each copy of a triangle that reaches into the tile, which is `width` x `height` pixels; at
// most 64 along an axis. With clampToEdge there is one, which may reach beyond. None for a triangle that is
// not finite or beyond 2^20 tiles, where single precision leaves nothing to see.
std::vector<std::array<Pixel, 3>> tileCopies(const std::array<mesh::Uv, 3>& uv, image::Wrap wrapU,
                                             image::Wrap wrapV, uint32_t width, uint32_t height);

}  // namespace filigree::jobs
