#pragma once

#include "quadmap/vq2_quadrant.h"

namespace filigree::quadmap {

// Transforms and codebook by algorithm 1, without indices.
Vq2 paperVq2(const std::array<Quadrant2, 4>& quadrants, bool literal);

}  // namespace filigree::quadmap
