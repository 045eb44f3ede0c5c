// The judge's fast tier: double arithmetic with proven margins. It says only what is certain.
#pragma once

#include "verify/limits.h"

#include <array>

namespace filigree::verify {

enum class Filtering : uint8_t { linear, nearest };

// A micro-triangle in the grid of one mip level and filter: a texel is the unit square at its integer
// coordinates, and a bilinear cell likewise, so linear filtering moves the texture space by half a texel.
struct RoundedShape {
    std::array<Point<double>, 3> corners;
    double guard = 0;
    double margin = 0;  // each corner is this close to its true place, with a factor of 8 to spare
};

// A bound on the rounding of corners that are weighted means of coordinates up to `size`.
constexpr double marginFor(double size) {
    return 0x1p-46 * (size > 1 ? size : 1);
}

// Shapes that span more rows and columns than this are not looked at in detail.
inline constexpr double largestSpan = 0x1p24;

// How many rows and columns the shape spans.
double spanOf(const RoundedShape& shape);

// What is certain of the shape under `limits`.
Verdict judgeRounded(const Layer& layer, Filtering filtering, const RoundedShape& shape,
                     const Limits& limits);

// The range of the filtered texels on the shape, which must span at most largestSpan.
Reach reachOf(const Layer& layer, Filtering filtering, const RoundedShape& shape);

}  // namespace filigree::verify
