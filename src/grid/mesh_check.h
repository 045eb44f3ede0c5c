// Whether a mesh of grids from outside holds what its tables say.
#pragma once

#include "filigree/core/executor.h"
#include "filigree/core/result.h"
#include "filigree/grid/vertex_grid.h"

namespace filigree::grid {

// What the comments of GridMesh promise. ErrorKind::format names the grid, the list or the vertex.
Status checkTables(const GridMesh& mesh, const Executor& executor);

}  // namespace filigree::grid
