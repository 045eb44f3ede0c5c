// Flat pictures of where compressed grids are off.
#pragma once

#include "filigree/grid/decode_grids.h"
#include "filigree/grid/encoded_grids.h"
#include "filigree/grid/vertex_grid.h"

#include "jobs/canvas.h"
#include "jobs/heat_map.h"

namespace filigree::jobs {

// One pixel or more for each sub-grid of 5 x 5 vertices: its largest error against the diagonal of its box,
// in colour, with the scale. Grids lie side by side, large ones first, each as its columns and rows run;
// sides above 4096 sub-grids are halved, largest errors kept. Clusters are not shown.
Canvas gridErrorMap(const grid::GridMesh& mesh, const grid::DecodedGrids& decoded, grid::Codec codec);

// The same for a page, its sides halved from 1024 sub-grids on.
HeatPanel gridErrorPanel(const grid::GridMesh& mesh, const grid::DecodedGrids& decoded, grid::Codec codec);

}  // namespace filigree::jobs
