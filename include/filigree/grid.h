// Dense meshes as compressed vertex grids under a hierarchy, and rays against them in place.
//
//     const mesh::FaceMesh mesh{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}}, {}, {}};
//     Result<grid::GridMesh> grids = grid::gridsOf(mesh);
//     const Result<grid::Lattice> lattice = grid::latticeForError(*grids, 1e-3);
//     const auto encoded = grid::encodeGrids(*grids, {.lattice = *lattice});
//     const grid::Hit hit = grid::Tracer(*encoded).closest({{0.5F, 0.5F, 1}, {0, 0, -1}});
#pragma once

#include "filigree/grid/attributes.h"
#include "filigree/grid/check.h"
#include "filigree/grid/cluster.h"
#include "filigree/grid/convert.h"
#include "filigree/grid/decode_grids.h"
#include "filigree/grid/encode_grids.h"
#include "filigree/grid/encoded_grids.h"
#include "filigree/grid/error.h"
#include "filigree/grid/heightfield.h"
#include "filigree/grid/lattice.h"
#include "filigree/grid/lattice_choice.h"
#include "filigree/grid/paper.h"
#include "filigree/grid/rays.h"
#include "filigree/grid/record_boxes.h"
#include "filigree/grid/shapes.h"
#include "filigree/grid/statistics.h"
#include "filigree/grid/tile.h"
#include "filigree/grid/vertex_grid.h"
