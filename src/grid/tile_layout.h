// The bytes of tiles of the lattice codec: docs/spec/lattice.md.
#pragma once

#include "filigree/core/bytes.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace filigree::grid {

inline constexpr unsigned tileQuads = 16;  // a tile's side, in quads, at most
inline constexpr unsigned blockQuads = 4;
inline constexpr unsigned tileBlocks = 4;  // a tile's side, in blocks, at most
inline constexpr size_t tileHeaderBytes = 40;
inline constexpr unsigned widestField = 24;  // bits: coordinates are taken modulo 2^24

// A patch is 5 x 5 places, numbered 0 to 4 each way. Where it has `steps` < 4 steps between vertices, some
// places are vacant: 3 steps use places 0 2 3 4, 2 steps 0 2 4, one step 0 4. The blocks are patches of
// vertices, the tile is a patch of the corners of its blocks.
inline constexpr unsigned patchSide = 5;
inline constexpr std::array<std::array<uint8_t, 5>, 5> placesOfSteps{
    {{}, {0, 4}, {0, 2, 4}, {0, 2, 3, 4}, {0, 1, 2, 3, 4}}};
constexpr unsigned midsOf(unsigned steps) {  // at place 2
    return steps >= 2 ? 1 : 0;
}
constexpr unsigned quartersOf(unsigned steps) {  // at places 1 and 3, or at 3
    return steps >= 2 ? steps - 2 : 0;
}
constexpr bool isPlace(unsigned steps, unsigned place) {
    return place % 4 == 0 || (place == 2 && steps >= 2) || (place == 3 && steps >= 3) ||
           (place == 1 && steps == 4);
}

// The residuals that share a width. The last three lie inside blocks, where a block's drop narrows them.
enum ResidualClass : unsigned {
    edgeMid,         // place 2 of an edge of a block
    edgeQuarter,     // places 1 and 3 of an edge
    insideCentre,    // (2, 2)
    insideCross,     // (2, 1), (1, 2), (3, 2), (2, 3)
    insideDiagonal,  // (1, 1), (3, 1), (1, 3), (3, 3)
};
inline constexpr unsigned residualClasses = 5;

enum class TileDiagonals : uint8_t { allAc, allBd, mixed };

struct TileHeader {
    uint32_t grid = 0;        // below 2^24
    unsigned columns = 1;     // quads, 1..16
    unsigned rows = 1;        // the same
    unsigned tileColumn = 0;  // the first quad's column / 16, below 2^12
    unsigned tileRow = 0;     // the same
    TileDiagonals diagonals = TileDiagonals::allAc;
    unsigned dominant = 0;            // an axis
    unsigned curve = 0;               // 0..7, how far quarters and crosses follow the bend around them, 1/32
    std::array<uint32_t, 3> base{};   // the vertex (0, 0), below 2^24
    std::array<unsigned, 3> reach{};  // [axis], of block boxes: bits 0-2 times 2^(bits 3-7), at most 2^22
    std::array<unsigned, 3> cornerWidth{};                         // [axis], 0..24, as all widths
    std::array<unsigned, 3> coarseWidth{};                         // [axis]
    std::array<std::array<unsigned, residualClasses>, 3> width{};  // [axis][class]
    std::array<unsigned, residualClasses> bias{4, 4, 4, 4, 4};     // of the dominant axis, eighths of 2^width
    // Of the lower and the higher minor axis, 1/32; by how much it grows per column and row, 1/256.
    std::array<int, 2> shear{};        // -32..31
    std::array<int, 2> shearColumn{};  // -16..15
    std::array<int, 2> shearRow{};     // the same

    [[nodiscard]] unsigned blockColumns() const { return (columns + blockQuads - 1) / blockQuads; }
    [[nodiscard]] unsigned blockRows() const { return (rows + blockQuads - 1) / blockQuads; }
    [[nodiscard]] unsigned blocks() const { return blockColumns() * blockRows(); }
    [[nodiscard]] unsigned columnsOf(unsigned blockColumn) const {  // quads of a block
        return std::min(blockQuads, columns - blockQuads * blockColumn);
    }
    [[nodiscard]] unsigned rowsOf(unsigned blockRow) const {
        return std::min(blockQuads, rows - blockQuads * blockRow);
    }
};

// Bits [at, at + count) of a word.
constexpr uint32_t fieldOf(uint32_t word, unsigned at, unsigned count) {
    return word >> at & ((1U << count) - 1);
}
constexpr int signedFieldOf(uint32_t word, unsigned at, unsigned count) {
    return static_cast<int32_t>(word << (32 - at - count)) >> (32 - count);
}

// From tileHeaderBytes bytes; any are a header, though not all a valid one (checkTile).
inline TileHeader loadTileHeader(const uint8_t* from) {
    const auto word = [&](unsigned k) { return loadLe<uint32_t>(from + 4 * k); };
    TileHeader head;
    head.grid = fieldOf(word(0), 0, 24);
    head.columns = 1 + fieldOf(word(0), 24, 4);
    head.rows = 1 + fieldOf(word(0), 28, 4);
    head.tileColumn = fieldOf(word(1), 0, 12);
    head.tileRow = fieldOf(word(1), 12, 12);
    head.diagonals = static_cast<TileDiagonals>(fieldOf(word(1), 24, 2));
    head.dominant = fieldOf(word(1), 26, 2);
    head.curve = fieldOf(word(1), 28, 3);
    for (unsigned axis = 0; axis < 3; ++axis) {
        head.base[axis] = fieldOf(word(2 + axis), 0, 24);
        head.reach[axis] = fieldOf(word(2 + axis), 24, 8);
        head.cornerWidth[axis] = fieldOf(word(5 + axis), 0, 5);
        head.coarseWidth[axis] = fieldOf(word(5 + axis), 5, 5);
        for (unsigned c = 0; c < 4; ++c) head.width[axis][c] = fieldOf(word(5 + axis), 10 + 5 * c, 5);
        head.width[axis][insideDiagonal] = fieldOf(word(8), 5 * axis, 5);
    }
    for (unsigned c = 0; c < residualClasses; ++c) head.bias[c] = fieldOf(word(8), 15 + 3 * c, 3);
    for (unsigned minor = 0; minor < 2; ++minor) {
        head.shear[minor] = signedFieldOf(word(9), 16 * minor, 6);
        head.shearColumn[minor] = signedFieldOf(word(9), 16 * minor + 6, 5);
        head.shearRow[minor] = signedFieldOf(word(9), 16 * minor + 11, 5);
    }
    return head;
}

inline void storeTileHeader(uint8_t* to, const TileHeader& head) {
    std::array<uint32_t, 10> words{};
    words[0] = head.grid | (head.columns - 1) << 24 | (head.rows - 1) << 28;
    words[1] = head.tileColumn | head.tileRow << 12 | static_cast<uint32_t>(head.diagonals) << 24 |
               head.dominant << 26 | head.curve << 28;
    for (unsigned axis = 0; axis < 3; ++axis) {
        words[2 + axis] = head.base[axis] | head.reach[axis] << 24;
        words[5 + axis] = head.cornerWidth[axis] | head.coarseWidth[axis] << 5;
        for (unsigned c = 0; c < 4; ++c) words[5 + axis] |= head.width[axis][c] << (10 + 5 * c);
        words[8] |= head.width[axis][insideDiagonal] << 5 * axis;
    }
    for (unsigned c = 0; c < residualClasses; ++c) words[8] |= head.bias[c] << (15 + 3 * c);
    for (unsigned minor = 0; minor < 2; ++minor) {
        const auto low = [](int value, unsigned bits) {
            return static_cast<uint32_t>(value) & ((1U << bits) - 1);
        };
        words[9] |= (low(head.shear[minor], 6) | low(head.shearColumn[minor], 5) << 6 |
                     low(head.shearRow[minor], 5) << 11)
                    << 16 * minor;
    }
    for (unsigned k = 0; k < words.size(); ++k) storeLe(to + size_t{4} * k, words[k]);
}

// One byte a block, row by row, at byte 40.
constexpr unsigned dropOf(uint8_t block) {  // bits off the widths inside the block, not below 0
    return (block & 3U) == 3 ? widestField : block & 3U;
}
constexpr unsigned lowReachOf(uint8_t block) {  // of the box, times reach
    return block >> 2 & 7U;
}
constexpr unsigned highReachOf(uint8_t block) {
    return block >> 5;
}
inline constexpr unsigned widestReachShift = 22;
constexpr uint32_t reachUnit(unsigned reach) {
    return (reach & 7U) << (reach >> 3);
}

// What a vertex of a class takes, all axes together. `drop` is 0 for edges.
inline unsigned vertexBits(const TileHeader& head, ResidualClass c, unsigned drop) {
    unsigned bits = 0;
    for (unsigned axis = 0; axis < 3; ++axis)
        bits += head.width[axis][c] - std::min(head.width[axis][c], drop);
    return bits;
}

// Where the parts of a record begin. Fields of a vertex follow each other: x, y, z.
struct TileParts {
    size_t blocks = tileHeaderBytes;  // in bytes
    size_t diagonals = 0;             // in bytes; two a block, present where they are mixed
    size_t bits = 0;                  // in bytes: where the bit string begins
    // In bits from there.
    uint32_t coarse = 0;
    uint32_t edgeMids = 0;      // horizontal edges row by row, then vertical edges row by row
    uint32_t edgeQuarters = 0;  // the same
    uint32_t insides = 0;       // of the blocks, row by row
};

// Vertices of one class on all horizontal edges of one line between blocks; of all vertical edges in one row
// of blocks. `perBlock` is midsOf or quartersOf.
template <class PerBlock>
unsigned edgesAcross(const TileHeader& head, PerBlock perBlock) {
    const unsigned blocks = head.blockColumns();
    return (blocks - 1) * perBlock(blockQuads) + perBlock(head.columnsOf(blocks - 1));
}
template <class PerBlock>
unsigned edgesDown(const TileHeader& head, PerBlock perBlock) {
    const unsigned blocks = head.blockRows();
    return (blocks - 1) * perBlock(blockQuads) + perBlock(head.rowsOf(blocks - 1));
}
// In the whole tile.
template <class PerBlock>
unsigned edgeVertices(const TileHeader& head, PerBlock perBlock) {
    return edgesAcross(head, perBlock) * (head.blockRows() + 1) +
           edgesDown(head, perBlock) * (head.blockColumns() + 1);
}

inline unsigned coarseVertices(const TileHeader& head) {  // without the tile's own corners
    return (head.blockColumns() + 1) * (head.blockRows() + 1) - 4;
}

inline TileParts tileParts(const TileHeader& head) {
    TileParts parts;
    parts.diagonals = parts.blocks + head.blocks();
    parts.bits = parts.diagonals + (head.diagonals == TileDiagonals::mixed ? 2 * head.blocks() : 0);
    const auto& corner = head.cornerWidth;
    const auto& coarse = head.coarseWidth;
    parts.coarse = 3 * (corner[0] + corner[1] + corner[2]);
    parts.edgeMids = parts.coarse + coarseVertices(head) * (coarse[0] + coarse[1] + coarse[2]);
    parts.edgeQuarters = parts.edgeMids + edgeVertices(head, midsOf) * vertexBits(head, edgeMid, 0);
    parts.insides = parts.edgeQuarters + edgeVertices(head, quartersOf) * vertexBits(head, edgeQuarter, 0);
    return parts;
}

// Vertices inside a block of columns x rows quads: centre, cross, diagonal.
struct InsideCounts {
    unsigned centres, crosses, diagonals;
};
constexpr InsideCounts insideCounts(unsigned columns, unsigned rows) {
    return {midsOf(columns) * midsOf(rows),
            midsOf(columns) * quartersOf(rows) + quartersOf(columns) * midsOf(rows),
            quartersOf(columns) * quartersOf(rows)};
}
inline uint32_t insideBits(const TileHeader& head, unsigned blockColumn, unsigned blockRow, unsigned drop) {
    const InsideCounts n = insideCounts(head.columnsOf(blockColumn), head.rowsOf(blockRow));
    return n.centres * vertexBits(head, insideCentre, drop) +
           n.crosses * vertexBits(head, insideCross, drop) +
           n.diagonals * vertexBits(head, insideDiagonal, drop);
}

// From tileParts().bits on, in bits.
inline uint32_t bitStringSize(const uint8_t* record, const TileHeader& head) {
    uint32_t bits = tileParts(head).insides;
    for (unsigned j = 0; j < head.blockRows(); ++j)
        for (unsigned i = 0; i < head.blockColumns(); ++i)
            bits += insideBits(head, i, j, dropOf(record[tileHeaderBytes + j * head.blockColumns() + i]));
    return bits;
}

}  // namespace filigree::grid
