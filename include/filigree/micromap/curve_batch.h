// Curve indices of many points at once.
#pragma once

#include "filigree/core/api.h"

#include <cstdint>
#include <span>

namespace filigree::micromap {

// barycentricsToIndex(u[k], v[k], levels[k]) into indices[k] for all k, in SIMD. All spans have one length;
// levels 0..15. NaN counts as 0.
FILIGREE_API void barycentricsToIndex(std::span<const float> u, std::span<const float> v,
                                      std::span<const uint32_t> levels, std::span<uint32_t> indices);

// planesOf(curveCoordinates(u[k], v[k], levels[k]), levels[k]) into a[k] and b[k] for all k, likewise.
FILIGREE_API void barycentricsToPlanes(std::span<const float> u, std::span<const float> v,
                                       std::span<const uint32_t> levels, std::span<uint32_t> a,
                                       std::span<uint32_t> b);

}  // namespace filigree::micromap
