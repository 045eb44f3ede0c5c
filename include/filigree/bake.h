// From textured triangles to opacity micromaps, and the choice of levels under a budget of bytes.
//
//     const std::array<uint8_t, 4> texels{0, 255, 255, 0};
//     const image::AlphaTexture leaf{image::alphaImageFrom8Bit(2, 2, texels)};
//     const std::vector<mesh::UvTriangle> triangles{{{{{0, 0}, {1, 0}, {0, 1}}}}};
//     const Result<bake::Baked> baked = bake::bake(triangles, leaf, image::AlphaTest{});
//     const Result<micromap::FlatSet> flat = micromap::flatten(baked->set);
#pragma once

#include "filigree/bake/bake.h"
#include "filigree/bake/budget.h"
