#pragma once

#include "quadmap/vq4_words.h"

namespace filigree::quadmap {

// Transforms and codebook by algorithm 2 of Fenney and Ozkan 2023, for all transforms of the quadrants; in
// VQ4+ both halves of a quadrant share theirs.
Book4 paperVq4(const Demand4& demand);

}  // namespace filigree::quadmap
