// Tiles of the lattice codec: up to 16 x 16 quads of a grid in one record (docs/spec/lattice.md).
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/box.h"
#include "filigree/core/result.h"
#include "filigree/grid/lattice.h"
#include "filigree/grid/vertex_grid.h"

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace filigree::grid {

// Which quads of which grid.
struct TilePlace {
    uint32_t grid = 0;     // below 2^24
    uint32_t column = 0;   // of the first quad, a multiple of 16
    uint32_t row = 0;      // the same
    unsigned columns = 0;  // quads, 1..16
    unsigned rows = 0;     // the same
    bool operator==(const TilePlace&) const = default;
};

// The tiles that cover grid number `grid`, row by row.
FILIGREE_API std::vector<TilePlace> tilesOf(const VertexGrid& grid, uint32_t index);

// A tile's vertices and diagonals; what is not covered is zero.
struct FILIGREE_API Tile {
    static constexpr unsigned side = 17;  // vertices
    TilePlace place;
    std::array<LatticePoint, side * side> points{};  // each coordinate in [0, latticeLimit)
    std::bitset<16 * 16> bd;                         // quad row * 16 + column has Diagonal::bd

    [[nodiscard]] LatticePoint& at(unsigned column, unsigned row) { return points[row * side + column]; }
    [[nodiscard]] const LatticePoint& at(unsigned column, unsigned row) const {
        return points[row * side + column];
    }
    // Of all its vertices, in lattice coordinates.
    [[nodiscard]] Box box() const;
    bool operator==(const Tile&) const = default;
};

// The tile at `place` of a mesh whose vertices lie in the lattice's range (grid/lattice_choice.h).
FILIGREE_API Tile snapTile(const GridMesh& mesh, const Lattice& lattice, const TilePlace& place);

// Appends the tile's record, a multiple of 8 bytes; decodeTile gives the same tile again.
FILIGREE_API void encodeTile(const Tile& tile, std::vector<uint8_t>& records);

// Checks the record at the start of `bytes` and all that decoding it relies on. Returns its size in bytes.
FILIGREE_API Result<size_t> checkTile(std::span<const uint8_t> bytes);

// Of a record that passed checkTile, or that encodeTile wrote; decodeTile is the plain decoder that judges
// the fast ones.
FILIGREE_API size_t tileBytes(const uint8_t* record);
FILIGREE_API TilePlace tilePlace(const uint8_t* record);
FILIGREE_API Tile decodeTile(const uint8_t* record);

}  // namespace filigree::grid
