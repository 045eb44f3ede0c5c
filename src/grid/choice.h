// Which grids a mesh is cut into.
#pragma once

#include "filigree/core/vec3.h"

#include "grid/growth.h"

#include <span>
#include <vector>

namespace filigree::grid {

struct Choice {
    std::vector<GrownGrid> grids;  // no triangle in two
    std::vector<uint32_t> loose;   // the triangles in none, rising
};

Choice chooseGrids(const Topology& topology, std::span<const Vec3> positions, const GrowthRules& rules);

}  // namespace filigree::grid
