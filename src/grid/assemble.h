// Grown grids and loose triangles as a GridMesh.
#pragma once

#include "filigree/core/executor.h"
#include "filigree/grid/convert.h"
#include "filigree/grid/vertex_grid.h"
#include "filigree/mesh/face_mesh.h"

#include "grid/choice.h"

namespace filigree::grid {

GridMesh assemble(const mesh::FaceMesh& mesh, const Topology& topology, const Choice& choice,
                  const ConvertOptions& options, const Executor& executor);

}  // namespace filigree::grid
