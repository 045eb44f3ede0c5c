// Lookups in SIMD.
#pragma once

#include "filigree/quadmap/reader.h"

namespace filigree::quadmap {

struct SquareHits {
    std::span<const uint32_t> maps;
    std::span<const Half> halves;
    std::span<const float> u;
    std::span<const float> v;
};

// The regions at the hits, in maps whose bytes number less than 2^31.
void lookupSquares(SquareFormat format, const uint8_t* maps, const SquareHits& hits,
                   std::span<Region> regions);

}  // namespace filigree::quadmap
