// Heightfields as grids.
#pragma once

#include "filigree/grid/vertex_grid.h"

#include <cstddef>
#include <cstdint>

namespace filigree::grid {

// One grid of columns x rows vertices, 2 to 65536 each: vertex (column, row) stands at (column * cell,
// heightOf(column, row), row * cell), diagonals are ac. The source triangles of quad q are 2 q and 2 q + 1.
template <class HeightOf>
GridMesh gridOfHeights(uint32_t columns, uint32_t rows, double cell, HeightOf&& heightOf) {
    GridMesh mesh;
    mesh.grids.push_back({columns, rows, 0, 0});
    mesh.vertices.reserve(size_t{columns} * rows);
    for (uint32_t row = 0; row < rows; ++row) {
        const auto z = static_cast<float>(row * cell);
        for (uint32_t column = 0; column < columns; ++column)
            mesh.vertices.push_back({static_cast<float>(column * cell), heightOf(column, row), z});
    }
    return mesh;
}

}  // namespace filigree::grid
