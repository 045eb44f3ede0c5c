#include "filigree/grid/statistics.h"

#include <algorithm>
#include <bit>

namespace filigree::grid {

double GridStatistics::shareAtLeast(uint32_t side) const {
    uint64_t quads = 0;
    for (const GridSizeClass& c : classes) quads += c.side >= side ? c.quads : 0;
    return triangles == 0 ? 0 : 2 * static_cast<double>(quads) / static_cast<double>(triangles);
}

GridStatistics statisticsOf(const GridMesh& mesh) {
    GridStatistics statistics;
    statistics.triangles = mesh.triangleCount();
    statistics.trianglesInGrids = 2 * mesh.quadCount();
    for (const VertexGrid& grid : mesh.grids) {
        const uint32_t side = std::bit_floor(std::min(grid.columns, grid.rows) - 1);
        auto found = std::ranges::lower_bound(statistics.classes, side, {}, &GridSizeClass::side);
        if (found == statistics.classes.end() || found->side != side)
            found = statistics.classes.insert(found, {side, 0, 0});
        ++found->grids;
        found->quads += grid.quadCount();
        statistics.largestGrid = std::max(statistics.largestGrid, grid.quadCount());
    }
    return statistics;
}

}  // namespace filigree::grid
