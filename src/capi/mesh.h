// The caller's meshes and heightfields as the rooms take them.
#pragma once

#include "filigree/grid/vertex_grid.h"
#include "filigree/mesh/face_mesh.h"

#include "filigree.h"

namespace filigree::capi {

mesh::FaceMesh facesOf(const filigree_mesh* given);
grid::GridMesh gridOf(const filigree_heightfield* given);

}  // namespace filigree::capi
