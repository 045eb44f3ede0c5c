#pragma once

#include "quadmap/vq2_quadrant.h"

namespace filigree::quadmap {

// Transforms and codebook of least cost, without indices.
Vq2 bestVq2(const std::array<Quadrant2, 4>& quadrants, const Weights& weights);

// The same for VQ2+.
Vq2 bestVq2Plus(const std::array<Quadrant2, 4>& quadrants, const Weights& weights);

}  // namespace filigree::quadmap
