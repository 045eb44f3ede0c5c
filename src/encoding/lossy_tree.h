// Pruning where each map is stored by itself.
#pragma once

#include "encoding/lossy_prune.h"

namespace filigree::encoding {

// The least of bits + price * cost over all prunings of each map: the choice at a node depends on what is
// below it alone (Chou, Lookabaugh and Gray 1989).
std::unique_ptr<Pruner> makeTreePruner(std::span<const WeightedMap> maps, micromap::Format format,
                                       const RateModel& model);

}  // namespace filigree::encoding
