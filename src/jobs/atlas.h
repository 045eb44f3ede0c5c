// All textures with holes in one image, as many programs for games have them.
#pragma once

#include "filigree/core/result.h"
#include "filigree/scene/scene.h"

#include <cstdint>
#include <string>
#include <vector>

namespace filigree::jobs {

// Copies the images of MASK and BLEND materials into one RGBA image of `side` x `side` texels and moves
// texture coordinates there. Texels keep their size and get neighbours as their wrap mode has them, repeats
// are unrolled: filtered alpha stays what it was, to within the rounding of texture coordinates. Left as they
// are: images without 8-bit alpha or colour, triangles over more than two repeats, and what finds no place,
// the smallest images first. The scene needs its colour and alpha decoded. Gives notes. ErrorKind::usage for
// a side of 0 or above image::maxImageSide.
Result<std::vector<std::string>> packAtlas(scene::Scene& scene, uint32_t side);

}  // namespace filigree::jobs
