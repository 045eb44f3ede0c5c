// Boxes into the bytes of a node.
#pragma once

#include "filigree/bvh/node.h"

#include <span>

namespace filigree::bvh {

// Sets the node's lattice and boxes, by slot: 1 to 8 finite ones, and empty ones where there is no child.
// Decoded, each contains the one given, which is asserted.
void setBoxes(Node& node, const std::array<Box, width>& children);

}  // namespace filigree::bvh
