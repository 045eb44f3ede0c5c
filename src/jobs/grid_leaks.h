// Rays that leave a closed surface between its triangles.
#pragma once

#include "filigree/core/vec3.h"
#include "filigree/grid/vertex_grid.h"

#include "jobs/grid_methods.h"
#include "jobs/random.h"

#include <cstdint>
#include <functional>

namespace filigree::jobs {

struct GridLeaks {
    uint64_t rays = 0;
    uint64_t misses = 0;
};

// A point from which a point of the surface can be seen through the inside.
using PointBehind = std::function<Vec3(const Vec3& target, Random& random)>;
Vec3 behindTorus(const Vec3& target, Random& random);
Vec3 behindBox(const Vec3& target, Random& random);

// Aims `count` rays at the vertices of `mesh`, which is closed, and at points of its edges, diagonals
// included, by turns. A ray has gone through the surface where it meets nothing, or meets something behind
// its target while the way there lies outside.
GridLeaks countLeaks(GridMethod& method, const grid::GridMesh& mesh, const PointBehind& pointBehind,
                     uint64_t count);

}  // namespace filigree::jobs
