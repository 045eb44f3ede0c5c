// Convex shapes widened by the guard square.
#pragma once

#include "filigree/core/api.h"
#include "filigree/image/patch.h"

#include <cstdint>
#include <span>
#include <vector>

namespace filigree::image {

// A corner of a widened shape: corner `corner` of the shape, moved by (x, y).
struct WidenedCorner {
    uint8_t corner = 0;
    double x = 0;
    double y = 0;
};

// The corners in order of the hull of the square [-guard, guard]^2 moved to each corner of a convex shape: at
// most four more than it has. With guard 0 the shape itself.
FILIGREE_API std::vector<WidenedCorner> widened(std::span<const PatchPoint<double>> corners, double guard);

}  // namespace filigree::image
