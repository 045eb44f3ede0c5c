// Which grids a mesh is cut into.
#pragma once

#include "filigree/core/stage.h"
#include "filigree/core/vec3.h"

#include "grid/growth.h"

#include <span>
#include <vector>

namespace filigree::grid {

struct Choice {
    std::vector<GrownGrid> grids;  // no triangle in two
    std::vector<uint32_t> loose;   // the triangles in none, rising
};

// Advances the stage by triangles. Where it is cancelled the choice is no use.
Choice chooseGrids(const Topology& topology, std::span<const Vec3> positions, const GrowthRules& rules,
                   const Stage& stage);

}  // namespace filigree::grid
