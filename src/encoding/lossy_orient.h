// Pruning where maps are merged up to the triangle's symmetries.
#pragma once

#include "encoding/lossy_prune.h"

#include <functional>

namespace filigree::encoding {

// Makes a pruner of maps that it looks into from then on.
using MakePruner = std::function<std::unique_ptr<Pruner>(std::span<const WeightedMap>)>;

// Turns each map to one orientation of its six, the same for all that are equal but for their orientation,
// and back when it is pruned; so the pruner takes them for equal.
std::unique_ptr<Pruner> makeOrientedPruner(std::span<const WeightedMap> maps, const MakePruner& make);

}  // namespace filigree::encoding
