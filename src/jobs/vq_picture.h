// A map beside what each encoding makes of it, as figure 9 of Fenney and Ozkan 2023.
#pragma once

#include "jobs/canvas.h"
#include "jobs/vq_maps.h"
#include "jobs/vq_measure.h"

namespace filigree::jobs {

// The first map of the input in two rows, of 16 and of 32 regions a side: the alpha, its square, and the
// square after the paper's, the best and the extended encoder. Regions that were known and are mixed now
// stand out.
Canvas drawMap(const VqInput& input, const VqMap& map);

}  // namespace filigree::jobs
