// Meshes to vertex grids (Benthin, Vaidyanathan and Woop 2021, section 3).
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/grid/vertex_grid.h"
#include "filigree/mesh/face_mesh.h"

#include <cstdint>

namespace filigree::grid {

// The most triangles that gridsOf takes.
inline constexpr uint64_t maxConvertTriangles = uint64_t{1} << 30;

// How meshes become grids.
struct ConvertOptions {
    // Grids take only quads whose diagonal is ac, as the paper's codec needs it; others go into grids turned
    // by a quarter, or stay loose.
    bool uniformDiagonals = false;
    // Quads of the mesh are cut along whichever diagonal suits their grid, since most files mean none: all
    // grids of quads get ac. Otherwise they are the triangles 0 1 2 and 0 2 3 (mesh::Face).
    bool turnQuads = false;
    // Keeps normals and texture coordinates. Vertices of one position that differ in them are then two, and
    // grids end there.
    bool attributes = true;
};

// Puts every triangle of `mesh` into one grid or among the loose triangles, once. Vertices are one where
// their position and attributes are equal to the bit (-0 equals 0). Quads of the mesh stay whole; triangles
// are paired to quads over shared edges as the grid grows. Growth is locally greedy: from a quad, whole rows
// and columns are added on all four sides, over edges that exactly two faces share in opposite directions,
// until none fits. What would take more bytes as a grid than as loose triangles stays loose, as do triangles
// with fewer than three different vertices. Triangles keep their winding, not their first vertex. The same
// answer for any executor. Fails with ErrorKind::limit above maxConvertTriangles, ErrorKind::format on
// what mesh::check refuses, ErrorKind::cancelled. Progress in triangles.
FILIGREE_API Result<GridMesh> gridsOf(const mesh::FaceMesh& mesh, const ConvertOptions& options = {},
                                      const Executor& executor = serialExecutor(),
                                      ProgressSink& progress = silentProgress());

}  // namespace filigree::grid
