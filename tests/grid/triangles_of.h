// The triangles of a grid mesh, one by one.
#pragma once

#include "filigree/grid/vertex_grid.h"

#include <array>

namespace filigree::grid {

// Calls visit(corners) for both triangles of each quad, grid by grid, then for the loose triangles.
template <class Visit>
void forEachTriangle(const GridMesh& mesh, Visit&& visit) {
    for (const VertexGrid& grid : mesh.grids) {
        for (uint64_t quad = 0; quad < grid.quadCount(); ++quad) {
            const uint64_t row = quad / (grid.columns - 1);
            const Vec3* a = &mesh.vertices[grid.firstVertex + row * grid.columns + quad % (grid.columns - 1)];
            const Vec3& b = a[1];
            const Vec3& c = a[grid.columns + 1];
            const Vec3& d = a[grid.columns];
            if (mesh.diagonalOf(grid.firstQuad + quad) == Diagonal::ac) {
                visit(std::array<Vec3, 3>{*a, b, c});
                visit(std::array<Vec3, 3>{*a, c, d});
            } else {
                visit(std::array<Vec3, 3>{*a, b, d});
                visit(std::array<Vec3, 3>{b, c, d});
            }
        }
    }
    for (const auto& t : mesh.looseTriangles)
        visit(std::array<Vec3, 3>{mesh.looseVertices[t[0]], mesh.looseVertices[t[1]],
                                  mesh.looseVertices[t[2]]});
}

}  // namespace filigree::grid
