// Which way round each map is stored.
#pragma once

#include "filigree/core/stage.h"

#include "encoding/sdag_sparse.h"

#include <span>
#include <vector>

namespace filigree::encoding::sdag {

// Chooses a symmetry for each map and turns it: that of an earlier map which it then equals, else the one
// that shares most leaves with earlier maps. Returns the symmetries, [map_count].
// Where the stage is cancelled, maps stay as they were.
std::vector<uint8_t> orient(std::span<SparseMap> maps, const Stage& stage);

}  // namespace filigree::encoding::sdag
