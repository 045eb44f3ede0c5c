// Micromaps in the form that pages take them.
#pragma once

#include "filigree/micromap/set.h"
#include "filigree/report/map_view.h"

namespace filigree::jobs {

// Record `index` of `set`, coarsened to `mostLevel` where it is finer. `sharers` stays 0.
report::CellMap cellMap(const micromap::FlatSet& set, uint32_t index, unsigned mostLevel);

}  // namespace filigree::jobs
