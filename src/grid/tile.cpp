#include "filigree/grid/tile.h"

#include "grid/tile_layout.h"

#include <algorithm>
#include <cassert>

namespace filigree::grid {

std::vector<TilePlace> tilesOf(const VertexGrid& grid, uint32_t index) {
    std::vector<TilePlace> places;
    for (uint32_t row = 0; row + 1 < grid.rows; row += tileQuads)
        for (uint32_t column = 0; column + 1 < grid.columns; column += tileQuads)
            places.push_back({index, column, row, std::min(tileQuads, grid.columns - 1 - column),
                              std::min(tileQuads, grid.rows - 1 - row)});
    return places;
}

Box Tile::box() const {
    Box box;
    for (unsigned row = 0; row <= place.rows; ++row)
        for (unsigned column = 0; column <= place.columns; ++column) {
            const LatticePoint& p = at(column, row);
            box.extend(Vec3{static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
        }
    return box;
}

Tile snapTile(const GridMesh& mesh, const Lattice& lattice, const TilePlace& place) {
    const VertexGrid& grid = mesh.grids[place.grid];
    assert(place.column + place.columns < grid.columns && place.row + place.rows < grid.rows);
    Tile tile;
    tile.place = place;
    for (unsigned row = 0; row <= place.rows; ++row)
        for (unsigned column = 0; column <= place.columns; ++column) {
            const uint64_t at =
                grid.firstVertex + uint64_t{place.row + row} * grid.columns + place.column + column;
            tile.at(column, row) = lattice.pointAt(mesh.vertices[at]);
        }
    for (unsigned row = 0; row < place.rows; ++row)
        for (unsigned column = 0; column < place.columns; ++column) {
            const uint64_t at =
                grid.firstQuad + uint64_t{place.row + row} * (grid.columns - 1) + place.column + column;
            tile.bd.set(row * tileQuads + column, mesh.diagonalOf(at) == Diagonal::bd);
        }
    return tile;
}

}  // namespace filigree::grid
