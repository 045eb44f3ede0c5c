// The first look at pieces of the outline, many at a time.
#pragma once

#include "filigree/image/outline.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace filigree::bake {

// A tile's lattice in single precision: a = ax (x - column) + ay (y - row) + a0 for a point in the cell
// (column, row) plus an offset, and b alike; see LatticeFrame in trace.cpp.
struct PlaceFrame {
    int32_t column = 0;
    int32_t row = 0;
    float ax = 0;
    float ay = 0;
    float a0 = 0;
    float bx = 0;
    float by = 0;
    float b0 = 0;
    float reach = 0;   // what guard and rounding may add to any lattice coordinate, single precision included
    float length = 0;  // lattice steps for a texel of bulge
    float steps = 0;   // 2^height
    int32_t rowShift = 0;  // height + 1
};

// Where a piece lies.
inline constexpr int32_t placeOutside = -2;  // in no micro-triangle of the tile
inline constexpr int32_t placeUnclear = -1;  // wants a closer look
// Otherwise a micro-triangle by its key, see TileCurve.

struct Places {
    static constexpr size_t capacity = 64;
    // All that a piece crosses are `first` and `second` (which may be the same), unless `first` is
    // placeUnclear.
    std::array<int32_t, capacity + image::Outline::padding> first;
    std::array<int32_t, capacity + image::Outline::padding> second;
};

// Finds the places of the pieces of `run`, at most Places::capacity. At most 2^20 cells may lie between the
// frame and a piece.
void placePieces(const image::Outline::PieceArrays& pieces, const image::Outline::Run& run,
                 const PlaceFrame& frame, Places& places);

}  // namespace filigree::bake
