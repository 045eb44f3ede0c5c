// Pictures of where compressed grids are off.
#pragma once

#include "filigree/grid/decode_grids.h"
#include "filigree/grid/vertex_grid.h"
#include "filigree/jobs/grids.h"

#include "jobs/canvas.h"

namespace filigree::jobs {

// One pixel or more for each sub-grid of 5 x 5 vertices: its largest error against the diagonal of its box,
// in colour, with the scale. Grids lie side by side, large ones first, each as its columns and rows run;
// sides above 4096 sub-grids are halved, largest errors kept. Clusters are not shown.
Canvas gridErrorMap(const grid::GridMesh& mesh, const grid::DecodedGrids& decoded,
                    const GridsSummary& summary);

}  // namespace filigree::jobs
