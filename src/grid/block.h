// Decoded parts of records, as rays are tested against them.
#pragma once

#include "filigree/bvh/walk.h"

#include "grid/tile_layout.h"

#include <array>
#include <cstdint>

namespace filigree::grid {

// 5 x 5 vertices at 5 row + column, and behind them what wide loads may read.
template <class T>
using PatchAxis = std::array<T, 32>;

// Up to 4 x 4 quads. Places without a vertex repeat the one before them in their row or column, so that what
// lies between has no area. Quad (column, row) is 4 row + column.
struct Block {
    alignas(64) std::array<PatchAxis<float>, 3> points;  // [axis], record coordinates
    uint32_t quads = 0;                                  // which there are
    uint32_t bd = 0;                                     // which have Diagonal::bd
};

// The corners of a tile's blocks as such a patch, and their boxes.
struct TileBlocks {
    alignas(64) std::array<PatchAxis<int32_t>, 3> points;  // [axis]
    alignas(64) std::array<std::array<float, 16>, 3> low;  // [axis][block]
    alignas(64) std::array<std::array<float, 16>, 3> high;
    uint32_t blocks = 0;  // which there are
};

// The index of the step that ends at place p + 1 of an axis, of [steps][p]; noStep where none does.
inline constexpr uint8_t noStep = 0xff;
inline constexpr std::array<std::array<uint8_t, 4>, 5> stepsAtPlaces{{
    {noStep, noStep, noStep, noStep},
    {noStep, noStep, noStep, 0},
    {noStep, 0, noStep, 1},
    {noStep, 0, 1, 2},
    {0, 1, 2, 3},
}};

// Which steps of a patch there are: bit 4 row + column.
constexpr uint32_t stepMask(unsigned columns, unsigned rows) {
    uint32_t mask = 0;
    for (unsigned y = 0; y < 4; ++y)
        for (unsigned x = 0; x < 4; ++x)
            if (stepsAtPlaces[columns][x] != noStep && stepsAtPlaces[rows][y] != noStep)
                mask |= 1U << (4 * y + x);
    return mask;
}

// The place whose vertex stands at place p too, of [steps][p].
inline constexpr std::array<std::array<uint8_t, 5>, 5> vertexAtPlace{{
    {0, 0, 0, 0, 0},
    {0, 0, 0, 0, 4},
    {0, 0, 2, 2, 4},
    {0, 0, 2, 3, 4},
    {0, 1, 2, 3, 4},
}};

}  // namespace filigree::grid
