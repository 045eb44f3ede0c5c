// Boxes around records.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/box.h"
#include "filigree/core/executor.h"
#include "filigree/grid/encoded_grids.h"

#include <vector>

namespace filigree::grid {

// Around the vertices that each record decodes to: [leaf_count], in lattice coordinates; of Codec::paper in
// world units. `grids` must have passed check() (grid/check.h). The same for any executor.
FILIGREE_API std::vector<Box> recordBoxes(const EncodedGrids& grids, const Executor& executor);

}  // namespace filigree::grid
