// What a conversion to grids came to.
#pragma once

#include "filigree/core/api.h"
#include "filigree/grid/vertex_grid.h"

#include <cstdint>
#include <vector>

namespace filigree::grid {

// Grids whose shorter side has `side` to 2 * side - 1 quads.
struct GridSizeClass {
    uint32_t side = 1;  // quads, a power of two
    uint64_t grids = 0;
    uint64_t quads = 0;
};

// How much of a mesh is in grids, and how large they are.
struct FILIGREE_API GridStatistics {
    uint64_t triangles = 0;
    uint64_t trianglesInGrids = 0;
    uint64_t largestGrid = 0;            // quads
    std::vector<GridSizeClass> classes;  // by rising side; only those with grids

    [[nodiscard]] double inGridShare() const {
        return triangles == 0 ? 0 : static_cast<double>(trianglesInGrids) / static_cast<double>(triangles);
    }
    // Share of all triangles that lie in grids of at least side x side quads; `side` a power of two.
    [[nodiscard]] double shareAtLeast(uint32_t side) const;
};

// Counts all of `mesh`.
FILIGREE_API GridStatistics statisticsOf(const GridMesh& mesh);

}  // namespace filigree::grid
