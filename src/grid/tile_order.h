// The order of vertices in a tile's bit string, and what their fields mean (docs/spec/lattice.md).
#pragma once

#include "grid/tile_layout.h"
#include "grid/tile_patch.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace filigree::grid {

inline constexpr unsigned noBlock = tileBlocks * tileBlocks;
inline constexpr unsigned frameSide = 4 * tileBlocks + 1;

// A tile's vertices at their places: vertex (px, py) of a block at (4 blockColumn + px, 4 blockRow + py).
// Vacant places mean nothing.
struct TileFrame {
    std::array<LatticePoint, patchSide * patchSide> coarse{};
    std::array<LatticePoint, frameSide * frameSide> fine{};

    LatticePoint& coarseAt(unsigned px, unsigned py) { return coarse[py * patchSide + px]; }
    LatticePoint& fineAt(unsigned x, unsigned y) { return fine[y * frameSide + x]; }
    Patch coarsePatch(const TileHeader& head) {
        return {coarse.data(), patchSide, head.blockColumns(), head.blockRows(), 0};
    }
    Patch blockPatch(const TileHeader& head, unsigned blockColumn, unsigned blockRow) {
        return {&fineAt(4 * blockColumn, 4 * blockRow), frameSide, head.columnsOf(blockColumn),
                head.rowsOf(blockRow), head.curve};
    }
};

// A column's place in the frame, of a tile of `columns` quads. Rows alike.
inline unsigned framePlace(unsigned columns, unsigned column) {
    const unsigned block = std::min(column, columns - 1) / blockQuads;
    const unsigned steps = std::min(blockQuads, columns - blockQuads * block);
    return 4 * block + placesOfSteps[steps][column - blockQuads * block];
}

// Calls visit(px, py) for each coarse vertex but the tile's corners.
template <class Visit>
void walkCoarse(const TileHeader& head, const Visit& visit) {
    for (unsigned py = 0; py < patchSide; ++py)
        for (unsigned px = 0; px < patchSide; ++px)
            if (isPlace(head.blockColumns(), px) && isPlace(head.blockRows(), py) &&
                (px % 4 != 0 || py % 4 != 0))
                visit(px, py);
}

// Calls visit(class, x, y, block) for each vertex on the edges of blocks, block being noBlock.
template <class Visit>
void walkEdges(const TileHeader& head, ResidualClass c, const Visit& visit) {
    const auto along = [&](unsigned steps, const auto& visitPlace) {
        for (const unsigned place : {1U, 2U, 3U})
            if (isPlace(steps, place) && (place == 2) == (c == edgeMid)) visitPlace(place);
    };
    for (unsigned j = 0; j <= head.blockRows(); ++j)
        for (unsigned i = 0; i < head.blockColumns(); ++i)
            along(head.columnsOf(i), [&](unsigned place) { visit(c, 4 * i + place, 4 * j, noBlock); });
    for (unsigned j = 0; j < head.blockRows(); ++j)
        for (unsigned i = 0; i <= head.blockColumns(); ++i)
            along(head.rowsOf(j), [&](unsigned place) { visit(c, 4 * i, 4 * j + place, noBlock); });
}

// Calls visit(class, x, y, block) for each vertex inside a block.
template <class Visit>
void walkInside(const TileHeader& head, unsigned i, unsigned j, const Visit& visit) {
    struct Place {
        ResidualClass c;
        uint8_t x, y;
    };
    static constexpr std::array<Place, 9> places{{{insideCentre, 2, 2},
                                                  {insideCross, 2, 1},
                                                  {insideCross, 1, 2},
                                                  {insideCross, 3, 2},
                                                  {insideCross, 2, 3},
                                                  {insideDiagonal, 1, 1},
                                                  {insideDiagonal, 3, 1},
                                                  {insideDiagonal, 1, 3},
                                                  {insideDiagonal, 3, 3}}};
    for (const Place& at : places)
        if (isPlace(head.columnsOf(i), at.x) && isPlace(head.rowsOf(j), at.y))
            visit(at.c, 4 * i + at.x, 4 * j + at.y, j * head.blockColumns() + i);
}

// Calls visit(class, x, y, block) for all vertices but the coarse ones.
template <class Visit>
void walkFine(const TileHeader& head, const Visit& visit) {
    walkEdges(head, edgeMid, visit);
    walkEdges(head, edgeQuarter, visit);
    for (unsigned j = 0; j < head.blockRows(); ++j)
        for (unsigned i = 0; i < head.blockColumns(); ++i) walkInside(head, i, j, visit);
}

inline constexpr unsigned evenBias = 4;
constexpr int32_t biasOf(unsigned bias, unsigned width) {
    return static_cast<int32_t>(bias << width >> 3);
}

// What a tile's header says of one vertex's fields.
struct FieldWidths {
    std::array<unsigned, 3> width{};
    unsigned dominantBias = evenBias;
};
inline FieldWidths fineFields(const TileHeader& head, ResidualClass c, unsigned drop) {
    FieldWidths fields;
    for (unsigned k = 0; k < 3; ++k) fields.width[k] = head.width[k][c] - std::min(head.width[k][c], drop);
    fields.dominantBias = head.bias[c];
    return fields;
}

// The lower and the higher minor axis.
constexpr std::array<unsigned, 2> minorAxes(unsigned dominant) {
    return {dominant == 0 ? 1U : 0U, dominant == 2 ? 1U : 2U};
}
// `slope` 256ths of a dominant residual.
constexpr int32_t sheared(int32_t slope, int32_t r) {
    return wrappedSum(wrappedProduct(slope, r), 128) >> 8;
}
// What the dominant residual r adds to that of minor axis `minor` (0 or 1) at place (x, y) of the frame.
inline int32_t shearOf(const TileHeader& head, unsigned minor, unsigned x, unsigned y, int32_t r) {
    return sheared(8 * head.shear[minor] + head.shearColumn[minor] * (static_cast<int32_t>(x) - 8) +
                       head.shearRow[minor] * (static_cast<int32_t>(y) - 8),
                   r);
}

}  // namespace filigree::grid
