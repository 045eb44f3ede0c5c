// Grids cut into sub-grids of the codec `paper`.
#pragma once

#include "filigree/core/box.h"
#include "filigree/grid/paper.h"
#include "filigree/grid/vertex_grid.h"

#include <cstdint>
#include <span>
#include <vector>

namespace filigree::grid {

// All sub-grids of a mesh, grid by grid and row by row, cut at multiples of four quads. The diagonal of each
// is that of its first quad.
std::vector<PaperPlace> subGridsOf(const GridMesh& mesh);
std::vector<PaperPlace> subGridsOf(const GridMesh& mesh, uint32_t grid);  // of that one alone

// How many vertices along a side belong to a record of `quads` quads from `first` on, of `all` along its
// grid: the last one belongs to the next record.
constexpr unsigned ownVertices(unsigned first, unsigned quads, unsigned all) {
    return first + quads == all ? quads + 1 : quads;
}

// Where vertex (column, row) of a sub-grid stands in the mesh.
inline uint64_t vertexOf(const VertexGrid& grid, const PaperPlace& place, unsigned column, unsigned row) {
    return grid.firstVertex + uint64_t{place.gridRow + row} * grid.columns + place.gridColumn + column;
}

// The vertices of a sub-grid; those past its quads are zero. `vertices` is in the layout of
// GridMesh::vertices.
PaperVertices subGridVertices(std::span<const Vec3> vertices, const VertexGrid& grid,
                              const PaperPlace& place);

// Around the vertices of its quads.
Box boxOf(const PaperVertices& vertices, const PaperPlace& place);

}  // namespace filigree::grid
