#include "grid/sub_grids.h"

#include <algorithm>

namespace filigree::grid {
namespace {

void cutRow(const GridMesh& mesh, uint32_t index, unsigned gridRow, std::vector<PaperPlace>& places) {
    const VertexGrid& grid = mesh.grids[index];
    PaperPlace place;
    place.grid = index;
    place.gridRow = gridRow;
    place.gridColumns = grid.columns - 1;
    place.gridRows = grid.rows - 1;
    place.rows = std::min(paperQuads, place.gridRows - gridRow);
    for (; place.gridColumn < place.gridColumns; place.gridColumn += paperQuads) {
        place.columns = std::min(paperQuads, place.gridColumns - place.gridColumn);
        place.diagonal =
            mesh.diagonalOf(grid.firstQuad + uint64_t{gridRow} * place.gridColumns + place.gridColumn);
        places.push_back(place);
    }
}

void cutGrid(const GridMesh& mesh, uint32_t index, std::vector<PaperPlace>& places) {
    for (unsigned row = 0; row + 1 < mesh.grids[index].rows; row += paperQuads)
        cutRow(mesh, index, row, places);
}

}  // namespace

std::vector<PaperPlace> subGridsOf(const GridMesh& mesh) {
    std::vector<PaperPlace> places;
    for (uint32_t k = 0; k < mesh.grids.size(); ++k) cutGrid(mesh, k, places);
    return places;
}

std::vector<PaperPlace> subGridsOf(const GridMesh& mesh, uint32_t grid) {
    std::vector<PaperPlace> places;
    cutGrid(mesh, grid, places);
    return places;
}

PaperVertices subGridVertices(std::span<const Vec3> vertices, const VertexGrid& grid,
                              const PaperPlace& place) {
    PaperVertices found{};
    for (unsigned row = 0; row <= place.rows; ++row) {
        const auto from = vertices.subspan(vertexOf(grid, place, 0, row), place.columns + 1);
        std::ranges::copy(from, found.begin() + row * paperSide);
    }
    return found;
}

Box boxOf(const PaperVertices& vertices, const PaperPlace& place) {
    Box box;
    for (unsigned row = 0; row <= place.rows; ++row) {
        for (unsigned column = 0; column <= place.columns; ++column)
            box.extend(vertices[row * paperSide + column]);
    }
    return box;
}

}  // namespace filigree::grid
