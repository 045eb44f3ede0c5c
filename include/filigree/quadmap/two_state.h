// Squares read without an any-hit shader: mixed regions hit or miss by chance (Fenney and Ozkan 2023, section
// 6).
#pragma once

#include "filigree/core/api.h"
#include "filigree/quadmap/reader.h"

#include <cstdint>

namespace filigree::quadmap {

// Which regions tell the chance at a point of a mixed region: the four whose centres lie around it, weighted
// bilinearly, or its own and the eight around that, weighted by a quadratic B-spline.
enum class Neighbourhood : uint8_t { two, three };

// The chance, 0..1, that the pair is hit at weights u and v: 0 in transparent and 1 in opaque regions; in
// mixed ones the weighted mean of the neighbourhood, where mixed regions count one half. Over the square's
// border the nearest region counts.
FILIGREE_API float opaqueChance(const SquareReader& reader, size_t map, Half half, float u, float v,
                                Neighbourhood neighbourhood);

// A number in [0, 1) from the bits of two weights and a seed: the same on every machine, and uniform over
// points.
FILIGREE_API float hashOf(float u, float v, uint32_t seed);

// Hit or miss: hashOf(u, v, seed) < opaqueChance(...), so that hits are as frequent as their chance.
FILIGREE_API bool isHit(const SquareReader& reader, size_t map, Half half, float u, float v,
                        Neighbourhood neighbourhood, uint32_t seed = 0);

}  // namespace filigree::quadmap
