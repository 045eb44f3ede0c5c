// Boxes into the bytes of a node.
#pragma once

#include "filigree/bvh/node.h"

#include <span>

namespace filigree::bvh {

// Sets the node's lattice and boxes; slots behind the last child become empty. 1 to 8 finite boxes, none
// empty. Decoded, each contains the one given, which is asserted.
void setBoxes(Node& node, std::span<const Box> children);

}  // namespace filigree::bvh
