// Positions that stand in several places of a mesh: where grids meet, and seams.
#pragma once

#include "filigree/grid/vertex_grid.h"

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace filigree::grid {

// A vertex of a grid, or a corner of a loose triangle.
struct MeshPlace {
    std::array<uint32_t, 3> position{};  // the bits of the source position, -0 as 0
    bool isLoose = false;
    uint64_t index = 0;  // into GridMesh::vertices, or 3 * loose triangle + corner
    bool operator==(const MeshPlace&) const = default;
    auto operator<=>(const MeshPlace&) const = default;
};

// Calls visit with all places of each position that a grid's vertex shares with others, one of them at least
// a loose corner or on the border of its grid. Of loose corners at one position only the first is given;
// grids' vertices come first. In the order of positions.
void forEachShared(const GridMesh& mesh, const std::function<void(std::span<const MeshPlace>)>& visit);

}  // namespace filigree::grid
