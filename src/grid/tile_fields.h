// Where the fields of a tile's patches are (docs/spec/lattice.md, "Bit string").
#pragma once

#include "grid/block.h"
#include "grid/tile_layout.h"
#include "grid/tile_order.h"

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

// Bits of one class of a patch: where its first vertex begins, and widths per axis.
struct ClassFields {
    std::array<unsigned, 3> width{};
    unsigned dominantBias = evenBias;
    [[nodiscard]] unsigned bits() const { return width[0] + width[1] + width[2]; }
};

// Where each vertex of a patch begins, in bits from the start of the bit string.
using FieldPlaces = std::array<std::array<int32_t, 4>, patchFours>;

// Of the edges of block (i, j).
inline void setEdgePlaces(const TileHeader& head, const TileParts& parts, unsigned i, unsigned j,
                          FieldPlaces& places) {
    const auto place = [&](uint32_t first, unsigned bits, auto perBlock, unsigned add) {
        const unsigned across = edgesAcross(head, perBlock);
        const unsigned upright =
            across * (head.blockRows() + 1) + j * (head.blockColumns() + 1) * perBlock(blockQuads);
        const unsigned down = perBlock(head.rowsOf(j));
        const std::array<unsigned, 4> index{j * across + i * perBlock(blockQuads), upright + (i + 1) * down,
                                            (j + 1) * across + i * perBlock(blockQuads), upright + i * down};
        std::array<int32_t, 4> at{};
        for (unsigned k = 0; k < 4; ++k) at[k] = static_cast<int32_t>(first + bits * (index[k] + add));
        return at;
    };
    const unsigned quarterBits = vertexBits(head, edgeQuarter, 0);
    places[edgeMids] = place(parts.edgeMids, vertexBits(head, edgeMid, 0), midsOf, 0);
    places[lowQuarters] = place(parts.edgeQuarters, quarterBits, quartersOf, 0);
    places[highQuarters] = place(parts.edgeQuarters, quarterBits, quartersOf, 1);
    // An edge of three steps has the higher quarter only.
    for (unsigned k = 0; k < 4; ++k)
        if ((k % 2 == 0 ? head.columnsOf(i) : head.rowsOf(j)) < 4)
            places[highQuarters][k] = places[lowQuarters][k];
}

// Where the inside of a block begins.
inline uint32_t insidePlace(const uint8_t* record, const TileHeader& head, const TileParts& parts, unsigned i,
                            unsigned j) {
    uint32_t at = parts.insides;
    const unsigned block = j * head.blockColumns() + i;
    for (unsigned before = 0; before < block; ++before)
        at += insideBits(head, before % head.blockColumns(), before / head.blockColumns(),
                         dropOf(record[tileHeaderBytes + before]));
    return at;
}

}  // namespace filigree::grid
