// Pictures of compressed grids as the surface that they are.
#pragma once

#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/grid/attributes.h"
#include "filigree/grid/decode_grids.h"
#include "filigree/grid/encoded_grids.h"
#include "filigree/grid/vertex_grid.h"
#include "filigree/report/colour_scale.h"
#include "filigree/scene/scene.h"

#include <cstdint>

namespace filigree::jobs {

// What a view is of: a mesh, and what became of it.
struct GridViewSource {
    const grid::GridMesh& mesh;
    const grid::EncodedGrids& grids;
    const grid::DecodedGrids& decoded;
    const grid::GridAttributes& attributes;
};

struct GridViews {
    scene::ColourImage lit;  // under sun and sky
    scene::ColourImage
        pieces;  // each grid in a colour of its own, light and dark by its records; clusters grey
    scene::ColourImage error;   // of each sub-grid against its box's diagonal (table 3 of the paper)
    report::ColourScale scale;  // of `error`
};

// `width` x `height` pixels each, from where trace::overview looks. All rays are traced through the records.
Result<GridViews> drawGridViews(const GridViewSource& source, uint32_t width, uint32_t height,
                                const Executor& executor, ProgressSink& progress);

}  // namespace filigree::jobs
