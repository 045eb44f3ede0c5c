// Boxes of a tile's blocks (docs/spec/lattice.md, "Box of a block").
#pragma once

#include "filigree/grid/lattice.h"
#include "filigree/grid/tile.h"

#include "grid/tile_layout.h"

#include <algorithm>
#include <array>

namespace filigree::grid {

struct LatticeBox {
    LatticePoint low{};
    LatticePoint high{};
};

inline LatticeBox boxAround(const LatticePoint& p) {
    return {p, p};
}
inline void extend(LatticeBox& box, const LatticePoint& p) {
    for (unsigned k = 0; k < 3; ++k) {
        box.low[k] = std::min(box.low[k], p[k]);
        box.high[k] = std::max(box.high[k], p[k]);
    }
}

// Of the corners of block (i, j), and of all its vertices.
inline LatticeBox cornerBox(const Tile& tile, const TileHeader& head, unsigned i, unsigned j) {
    const unsigned left = blockQuads * i, right = left + head.columnsOf(i);
    const unsigned top = blockQuads * j, bottom = top + head.rowsOf(j);
    LatticeBox box = boxAround(tile.at(left, top));
    extend(box, tile.at(right, top));
    extend(box, tile.at(left, bottom));
    extend(box, tile.at(right, bottom));
    return box;
}
inline LatticeBox vertexBox(const Tile& tile, const TileHeader& head, unsigned i, unsigned j) {
    LatticeBox box = boxAround(tile.at(blockQuads * i, blockQuads * j));
    for (unsigned row = 0; row <= head.rowsOf(j); ++row)
        for (unsigned column = 0; column <= head.columnsOf(i); ++column)
            extend(box, tile.at(blockQuads * i + column, blockQuads * j + row));
    return box;
}

// What the record says: the box of the corners widened by what the block's byte and the header give.
inline LatticeBox widenedBox(LatticeBox corners, const TileHeader& head, uint8_t block) {
    const unsigned low = lowReachOf(block), high = highReachOf(block);
    for (unsigned k = 0; k < 3; ++k) {
        const auto unit = static_cast<int32_t>(reachUnit(head.reach[k]));
        const bool main = k == head.dominant;
        corners.low[k] -= static_cast<int32_t>(main ? low : std::max(low, high)) * unit;
        corners.high[k] += static_cast<int32_t>(main ? high : std::max(low, high)) * unit;
    }
    return corners;
}

}  // namespace filigree::grid
