// Which way round each map is stored.
#pragma once

#include "filigree/core/executor.h"

#include "encoding/sdag_sparse.h"

#include <span>
#include <vector>

namespace filigree::encoding::sdag {

// Chooses a symmetry for each map and turns it: that of an earlier map which it then equals, else the one
// that shares most leaves with earlier maps. Returns the symmetries, [map_count].
std::vector<uint8_t> orient(std::span<SparseMap> maps, const Executor& executor);

}  // namespace filigree::encoding::sdag
