// Everything back to vertices, plainly: for errors, for tests, and to compare with.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/executor.h"
#include "filigree/grid/encoded_grids.h"
#include "filigree/grid/vertex_grid.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace filigree::grid {

// Decoded positions, world units.
struct DecodedGrids {
    std::vector<Vec3> vertices;                       // as GridMesh::vertices, world units
    std::vector<std::array<Vec3, 3>> looseTriangles;  // in the order of the clusters
};

// `grids` must have passed checkPlaces() (grid/check.h) with the same table. A vertex that several records of
// a grid hold is taken from the one whose quads begin there, at the far ends of the grid from the last.
FILIGREE_API DecodedGrids decodeGrids(const EncodedGrids& grids, std::span<const VertexGrid> table,
                                      uint32_t looseTriangles, const Executor& executor);

// The decoded surface as a mesh with the tables and sources of `mesh`, which `grids` was made from. Vertices
// of loose triangles stand once for each corner.
FILIGREE_API GridMesh decodedMesh(const EncodedGrids& grids, const GridMesh& mesh, const Executor& executor);

}  // namespace filigree::grid
