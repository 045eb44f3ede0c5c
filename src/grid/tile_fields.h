// Where the fields of a tile's patches are (docs/spec/lattice.md, "Bit string").
#pragma once

#include "grid/block.h"
#include "grid/tile_layout.h"
#include "grid/tile_order.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace filigree::grid {

// Vertices of a patch but its corners, four of a kind together, clockwise from the top: of edges the mid,
// the lower quarter and the higher one; then crosses, diagonals, and the centre.
enum PatchFour : unsigned { edgeMids, lowQuarters, highQuarters, crosses, diagonals, middle };
inline constexpr unsigned patchFours = 6;
inline constexpr std::array<ResidualClass, patchFours> classOfFour{edgeMid,     edgeQuarter,    edgeQuarter,
                                                                   insideCross, insideDiagonal, insideCentre};

struct PatchPlace {
    uint8_t x, y;
};
inline constexpr std::array<std::array<PatchPlace, 4>, patchFours> placesOfFour{{
    {{{2, 0}, {4, 2}, {2, 4}, {0, 2}}},
    {{{1, 0}, {4, 1}, {1, 4}, {0, 1}}},
    {{{3, 0}, {4, 3}, {3, 4}, {0, 3}}},
    {{{2, 1}, {3, 2}, {2, 3}, {1, 2}}},
    {{{1, 1}, {3, 1}, {3, 3}, {1, 3}}},
    {{{2, 2}, {2, 2}, {2, 2}, {2, 2}}},
}};

// The same by axis.
struct FourPlaces {
    alignas(16) std::array<std::array<int32_t, 4>, patchFours> x, y;
};
constexpr FourPlaces fourPlacesByAxis() {
    FourPlaces places{};
    for (unsigned four = 0; four < patchFours; ++four)
        for (unsigned k = 0; k < 4; ++k) {
            places.x[four][k] = placesOfFour[four][k].x;
            places.y[four][k] = placesOfFour[four][k].y;
        }
    return places;
}
inline constexpr FourPlaces fourPlaces = fourPlacesByAxis();

// In vertices from the first of the class; 0 where a vertex is vacant.
using FieldIndices = std::array<std::array<uint8_t, 4>, patchFours>;

// Of all coarse vertices but the tile's corners, which have one class, by their order row by row.
constexpr FieldIndices coarseFieldIndices(unsigned columns, unsigned rows) {
    FieldIndices indices{};
    for (unsigned four = 0; four < patchFours; ++four)
        for (unsigned k = 0; k < 4; ++k) {
            const PatchPlace at = placesOfFour[four][k];
            if (!isPlace(columns, at.x) || !isPlace(rows, at.y)) continue;
            unsigned index = 0;
            for (unsigned y = 0; y < patchSide; ++y)
                for (unsigned x = 0; x < patchSide; ++x)
                    if ((y < at.y || (y == at.y && x < at.x)) && isPlace(columns, x) && isPlace(rows, y) &&
                        (x % 4 != 0 || y % 4 != 0))
                        ++index;
            indices[four][k] = static_cast<uint8_t>(index);
        }
    return indices;
}

// Of a block's vertices inside it.
constexpr FieldIndices insideFieldIndices(unsigned columns, unsigned rows) {
    FieldIndices indices{};
    unsigned count = 0;
    for (const unsigned k : {0U, 3U, 1U, 2U}) {
        const PatchPlace at = placesOfFour[crosses][k];
        if (isPlace(columns, at.x) && isPlace(rows, at.y))
            indices[crosses][k] = static_cast<uint8_t>(count++);
    }
    count = 0;
    for (const unsigned k : {0U, 1U, 3U, 2U}) {
        const PatchPlace at = placesOfFour[diagonals][k];
        if (isPlace(columns, at.x) && isPlace(rows, at.y))
            indices[diagonals][k] = static_cast<uint8_t>(count++);
    }
    return indices;
}

template <class Of>
constexpr auto forAllSteps(const Of& of) {
    std::array<std::array<decltype(of(1U, 1U)), 5>, 5> table{};
    for (unsigned columns = 1; columns <= 4; ++columns)
        for (unsigned rows = 1; rows <= 4; ++rows) table[columns][rows] = of(columns, rows);
    return table;
}
inline constexpr auto coarseFields = forAllSteps(coarseFieldIndices);
inline constexpr auto insideFields = forAllSteps(insideFieldIndices);

// Where each vertex of a patch begins, in bits from the start of the bit string.
using FieldPlaces = std::array<std::array<uint32_t, 4>, patchFours>;

inline constexpr unsigned coarseClass = residualClasses;
TilePlan tilePlan(const uint8_t* record, const TileHeader& head);

constexpr unsigned blocksOf(unsigned quads) {
    return (quads + blockQuads - 1) / blockQuads;
}
constexpr unsigned stepsOfBlock(unsigned quads, unsigned block) {
    return std::min(blockQuads, quads - blockQuads * block);
}

// Of the edges of block (i, j).
inline void setEdgePlaces(const TilePlan& plan, unsigned i, unsigned j, FieldPlaces& places) {
    const unsigned blockColumns = blocksOf(plan.columns), blockRows = blocksOf(plan.rows);
    const unsigned columns = stepsOfBlock(plan.columns, i), rows = stepsOfBlock(plan.rows, j);
    const unsigned lastColumns = stepsOfBlock(plan.columns, blockColumns - 1);
    const auto set = [&](PatchFour four, uint32_t first, unsigned bits, auto perBlock) {
        const unsigned across = (blockColumns - 1) * perBlock(blockQuads) + perBlock(lastColumns);
        const unsigned upright =
            across * (blockRows + 1) + j * (blockColumns + 1) * perBlock(blockQuads) + i * perBlock(rows);
        const unsigned level = j * across + i * perBlock(blockQuads);
        places[four] = {first + bits * level, first + bits * (upright + perBlock(rows)),
                        first + bits * (level + across), first + bits * upright};
    };
    set(edgeMids, plan.edgeMids, plan.edgeMidBits, midsOf);
    set(lowQuarters, plan.edgeQuarters, plan.edgeQuarterBits, quartersOf);
    // An edge of three steps has the higher quarter only.
    for (unsigned k = 0; k < 4; ++k) {
        const bool isBoth = (k % 2 == 0 ? columns : rows) == 4;
        places[highQuarters][k] = places[lowQuarters][k] + (isBoth ? plan.edgeQuarterBits : 0U);
    }
}

// Of what lies inside block number `block`, whose size in quads is columns x rows.
inline void setInsidePlaces(const TilePlan& plan, unsigned block, unsigned columns, unsigned rows,
                            FieldPlaces& places) {
    const auto& bits = plan.insideBits[plan.drops[block]];
    const InsideCounts counts = insideCounts(columns, rows);
    uint32_t at = plan.inside[block];
    for (const unsigned four : {unsigned{middle}, unsigned{crosses}, unsigned{diagonals}}) {
        const unsigned vertex = bits[classOfFour[four] - insideCentre];
        for (unsigned k = 0; k < 4; ++k) places[four][k] = at + vertex * insideFields[columns][rows][four][k];
        at += vertex * (four == middle ? counts.centres : counts.crosses);
    }
}

}  // namespace filigree::grid
