// Rays to measure grids with.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/box.h"
#include "filigree/grid/rays.h"
#include "filigree/scene/scene.h"
#include "filigree/trace/embree_grids.h"

#include <cstdint>
#include <vector>

namespace filigree::trace {

// A camera that sees all of a box, from a little above, for a picture `aspect` times as wide as high.
FILIGREE_API scene::Camera overviewOf(const Box& box, float aspect);

// One ray through the middle of each pixel, tile by tile, and what follows where it hits.
struct GridRaySets {
    std::vector<grid::Ray> primary;
    std::vector<grid::Ray> bounce;    // diffuse, from each primary hit, in the same order
    std::vector<grid::Ray> ao;        // the same directions, of limited length: any hit
    std::vector<grid::Ray> shuffled;  // the bounce rays in random order
};

// Which rays, and how far they reach.
struct GridRayOptions {
    uint32_t width = 800;  // pixels
    uint32_t height = 800;
    float aoShare = 0.1F;    // length of AO rays, of the box's diagonal
    float offShare = 1e-4F;  // how far rays start off the surface, of the diagonal
    uint32_t seed = 1;
};

// `reference` gives the primary hits; `bounds` are those of what it holds.
FILIGREE_API GridRaySets gridRaySets(const EmbreeGrids& reference, const Box& bounds,
                                     const scene::Camera& camera, const GridRayOptions& options);

}  // namespace filigree::trace
