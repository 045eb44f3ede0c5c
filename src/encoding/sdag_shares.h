// Opaque shares of the nodes of a graph.
#pragma once

#include "encoding/sdag_place.h"

#include <cstdint>

namespace filigree::encoding::sdag {

// Two bytes for each node in file order, low heights first: the share of its micro-triangles on the opaque
// side, rounded to 1/65535.
void writeShares(const Graph& graph, const Placement& placement, uint8_t* to);

}  // namespace filigree::encoding::sdag
