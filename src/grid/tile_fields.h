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

// The same for vectors of places.
using FieldIndexLanes = std::array<std::array<int32_t, 4>, patchFours>;
constexpr FieldIndexLanes lanesOf(const FieldIndices& indices) {
    FieldIndexLanes lanes{};
    for (unsigned four = 0; four < patchFours; ++four)
        for (unsigned k = 0; k < 4; ++k) lanes[four][k] = indices[four][k];
    return lanes;
}
alignas(16) inline constexpr auto coarseFieldLanes = forAllSteps([](unsigned columns, unsigned rows) {
    return lanesOf(coarseFieldIndices(columns, rows));
});
alignas(16) inline constexpr FieldIndexLanes insideFieldLanes = lanesOf(insideFieldIndices(4, 4));

constexpr unsigned blocksOf(unsigned quads) {
    return (quads + blockQuads - 1) / blockQuads;
}
constexpr unsigned stepsOfBlock(unsigned quads, unsigned block) {
    return std::min(blockQuads, quads - blockQuads * block);
}

// Fields of a header that widths are in: words 5 to 7, and of the class insideDiagonal word 8.
inline constexpr unsigned coarseField = 5;
constexpr unsigned fieldOfClass(ResidualClass c) {
    return 10 + 5 * c;
}

// Where the parts of a record begin, without taking apart its header.
class TilePlan {
  public:
    explicit TilePlan(const uint8_t* record) : record_(record) {
        const uint32_t size = loadLe<uint32_t>(record) >> 24;
        columns = 1 + (size & 15);
        rows = 1 + (size >> 4);
        const unsigned blocks = blocksOf(columns) * blocksOf(rows);
        diagonals = static_cast<TileDiagonals>(fieldOf(loadLe<uint32_t>(record + 4), 24, 2));
        bits = static_cast<uint32_t>(tileHeaderBytes) + blocks +
               (diagonals == TileDiagonals::mixed ? 2 * blocks : 0);
        coarse = 3 * vertexBitsAt(0);
        edgeMids = coarse + vertexBitsAt(coarseField) * ((blocksOf(columns) + 1) * (blocksOf(rows) + 1) - 4);
        edgeQuarters = edgeMids + vertexBitsOf(edgeMid, 0) * edgesOf(midsOf);
        insides = edgeQuarters + vertexBitsOf(edgeQuarter, 0) * edgesOf(quartersOf);
    }

    [[nodiscard]] bool isWhole() const { return columns == tileQuads && rows == tileQuads; }

    // Of a vertex, all axes together; `field` is where words 5 to 7 hold its width.
    [[nodiscard]] unsigned vertexBitsAt(unsigned field) const {
        return fieldOf(word(5), field, 5) + fieldOf(word(6), field, 5) + fieldOf(word(7), field, 5);
    }
    [[nodiscard]] unsigned vertexBitsOf(ResidualClass c, unsigned drop) const {
        const auto narrowed = [&](uint32_t bearer, unsigned field) {
            const unsigned width = fieldOf(bearer, field, 5);
            return width > drop ? width - drop : 0;
        };
        if (c == insideDiagonal) return narrowed(word(8), 0) + narrowed(word(8), 5) + narrowed(word(8), 10);
        const unsigned field = fieldOfClass(c);
        return narrowed(word(5), field) + narrowed(word(6), field) + narrowed(word(7), field);
    }

    // Of all that is inside a block of columns x rows quads.
    [[nodiscard]] uint32_t insideBits(unsigned blockWidth, unsigned blockHeight, unsigned drop) const {
        const InsideCounts n = insideCounts(blockWidth, blockHeight);
        return n.centres * vertexBitsOf(insideCentre, drop) + n.crosses * vertexBitsOf(insideCross, drop) +
               n.diagonals * vertexBitsOf(insideDiagonal, drop);
    }
    // In bits: where the inside of block number `block` begins.
    [[nodiscard]] uint32_t insideOf(unsigned block) const {
        return isWhole() ? insideOfWhole(block) : insideOfAny(block);
    }

    uint32_t bits;                                     // in bytes: where the bit string begins
    uint32_t coarse, edgeMids, edgeQuarters, insides;  // in bits from there
    unsigned columns, rows;                            // quads
    TileDiagonals diagonals;

  private:
    [[nodiscard]] uint32_t word(unsigned k) const { return loadLe<uint32_t>(record_ + size_t{4} * k); }

    // Vertices of one class on all edges of blocks.
    template <class PerBlock>
    [[nodiscard]] unsigned edgesOf(PerBlock perBlock) const {
        const auto along = [&](unsigned quads) {
            const unsigned last = blocksOf(quads) - 1;
            return last * perBlock(blockQuads) + perBlock(stepsOfBlock(quads, last));
        };
        return along(columns) * (blocksOf(rows) + 1) + along(rows) * (blocksOf(columns) + 1);
    }

    [[nodiscard]] uint32_t insideOfAny(unsigned block) const {
        uint32_t at = insides;
        for (unsigned k = 0; k < block; ++k) {
            const unsigned i = k % blocksOf(columns), j = k / blocksOf(columns);
            at += insideBits(stepsOfBlock(columns, i), stepsOfBlock(rows, j),
                             dropOf(record_[tileHeaderBytes + k]));
        }
        return at;
    }
    // The same where all 16 blocks are whole: bytes of one drop are counted together.
    [[nodiscard]] uint32_t insideOfWhole(unsigned block) const {
        constexpr uint64_t ones = 0x0101010101010101;
        const auto before = [](unsigned count) {
            return count >= 8 ? ~uint64_t{0} : (uint64_t{1} << 8 * count) - 1;
        };
        const auto first = loadLe<uint64_t>(record_ + tileHeaderBytes) & before(block);
        const auto second =
            loadLe<uint64_t>(record_ + tileHeaderBytes + 8) & (block > 8 ? before(block - 8) : 0);
        const auto count = [&](const auto& isOne) {
            return static_cast<uint32_t>(((isOne(first) & ones) + (isOne(second) & ones)) * ones >> 56);
        };
        const uint32_t one = count([](uint64_t w) { return w & ~(w >> 1); });
        const uint32_t two = count([](uint64_t w) { return w >> 1 & ~w; });
        const uint32_t all = count([](uint64_t w) { return w & w >> 1; });
        uint32_t at = insides + (block - one - two - all) * insideBits(4, 4, 0);
        if (one != 0) at += one * insideBits(4, 4, 1);
        if (two != 0) at += two * insideBits(4, 4, 2);
        return at;
    }

    const uint8_t* record_;
};

// Where each vertex of a patch begins, in bits from the start of the bit string.
using FieldPlaces = std::array<std::array<uint32_t, 4>, patchFours>;

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
    const unsigned quarterBits = plan.vertexBitsOf(edgeQuarter, 0);
    set(edgeMids, plan.edgeMids, plan.vertexBitsOf(edgeMid, 0), midsOf);
    set(lowQuarters, plan.edgeQuarters, quarterBits, quartersOf);
    // An edge of three steps has the higher quarter only.
    for (unsigned k = 0; k < 4; ++k) {
        const bool isBoth = (k % 2 == 0 ? columns : rows) == 4;
        places[highQuarters][k] = places[lowQuarters][k] + (isBoth ? quarterBits : 0U);
    }
}

// Of what lies inside block number `block`, whose size in quads is columns x rows.
inline void setInsidePlaces(const TilePlan& plan, unsigned block, unsigned columns, unsigned rows,
                            unsigned drop, FieldPlaces& places) {
    const InsideCounts counts = insideCounts(columns, rows);
    uint32_t at = plan.insideOf(block);
    for (const unsigned four : {unsigned{middle}, unsigned{crosses}, unsigned{diagonals}}) {
        const unsigned vertex = plan.vertexBitsOf(classOfFour[four], drop);
        for (unsigned k = 0; k < 4; ++k) places[four][k] = at + vertex * insideFields[columns][rows][four][k];
        at += vertex * (four == middle ? counts.centres : counts.crosses);
    }
}

// Of block 4 j + i of 16 whole ones: its edges' mids, in vertices from the first; quarters are twice as many.
struct WholeEdges {
    alignas(16) std::array<std::array<int32_t, 4>, 16> mids;
};
constexpr WholeEdges wholeEdgesOfTile() {
    WholeEdges edges{};
    for (int32_t j = 0; j < 4; ++j)
        for (int32_t i = 0; i < 4; ++i) {
            const int32_t level = 4 * j + i, upright = 20 + 5 * j + i;
            edges.mids[static_cast<size_t>(4 * j + i)] = {level, upright + 1, level + 4, upright};
        }
    return edges;
}
inline constexpr WholeEdges wholeEdges = wholeEdgesOfTile();

}  // namespace filigree::grid
