#include "filigree/grid/decode_grids.h"

#include "capi/arguments.h"
#include "capi/call.h"
#include "capi/fill.h"
#include "capi/grids.h"
#include "capi/sized.h"

#include <algorithm>

namespace filigree::capi {
namespace {

constexpr filigree_surface surfaceDefaults = FILIGREE_SURFACE_INIT;

class TriangleWriter {
  public:
    TriangleWriter(const filigree_grids& grids, std::span<filigree_grid_triangle> to)
        : grids_(grids),
          decoded_(grid::decodeGrids(grids.file.grids, grids.file.table, grids.file.looseTriangles,
                                     serialExecutor())),
          to_(to.begin()) {}

    void write() {
        for (uint32_t g = 0; g < grids_.file.table.size(); ++g) writeGrid(g);
        for (uint32_t k = 0; k < decoded_.looseTriangles.size(); ++k) {
            grid::Hit at;
            at.grid = grid::looseGrid;
            at.column = k;
            put(decoded_.looseTriangles[k], at);
        }
    }

  private:
    void writeGrid(uint32_t number) {
        const grid::VertexGrid& grid = grids_.file.table[number];
        grid::Hit at;
        at.grid = number;
        for (at.row = 0; at.row + 1 < grid.rows; ++at.row) {
            for (at.column = 0; at.column + 1 < grid.columns; ++at.column) writeQuad(grid, at);
        }
    }

    void writeQuad(const grid::VertexGrid& grid, grid::Hit& at) {
        for (at.half = 0; at.half < 2; ++at.half) {
            std::array<Vec3, 3> positions;
            const auto vertices = grid::verticesOf(grids_.file.attributes, grid, at);
            for (size_t k = 0; k < 3; ++k) positions[k] = decoded_.vertices[vertices[k]];
            put(positions, at);
        }
    }

    void put(const std::array<Vec3, 3>& positions, const grid::Hit& at) {
        filigree_grid_triangle& triangle = *to_++;
        for (size_t k = 0; k < 3; ++k) std::ranges::copy(positions[k], triangle.positions[k]);
        triangle.source = sourceOf(grids_, at);
    }

    const filigree_grids& grids_;
    grid::DecodedGrids decoded_;
    std::span<filigree_grid_triangle>::iterator to_;
};

// A hit of these grids, from the caller.
grid::Hit hitOf(const filigree_grids& grids, const filigree_hit& from) {
    const bool isLoose = from.grid == grid::looseGrid;
    if (!isLoose && from.grid >= grids.file.table.size())
        fail(FILIGREE_ERROR_ARGUMENT, "hit.grid: is {}, there are {} grids", from.grid,
             grids.file.table.size());
    const uint32_t columns = isLoose ? grids.file.looseTriangles : grids.file.table[from.grid].columns - 1;
    const uint32_t rows = isLoose ? UINT32_MAX : grids.file.table[from.grid].rows - 1;
    if (from.column >= columns || from.row >= rows || from.half > 1) {
        fail(FILIGREE_ERROR_ARGUMENT, "hit: column {}, row {}, half {} are not in grid {}", from.column,
             from.row, from.half, from.grid);
    }
    grid::Hit hit;
    hit.grid = from.grid;
    hit.column = from.column;
    hit.row = from.row;
    hit.half = static_cast<uint8_t>(from.half);
    hit.u = from.u;
    hit.v = from.v;
    return hit;
}

filigree_surface surfaceOf(const filigree_grids& grids, const grid::Hit& hit) {
    const auto point = grid::surfaceAt(grids.file.attributes, grids.file.table, hit);
    filigree_surface surface = surfaceDefaults;
    surface.grid_u = point.gridU;
    surface.grid_v = point.gridV;
    if (point.normal) {
        surface.has_normal = 1;
        std::ranges::copy(*point.normal, surface.normal);
    }
    if (point.uv) {
        surface.has_uv = 1;
        surface.uv[0] = point.uv->u;
        surface.uv[1] = point.uv->v;
    }
    return surface;
}

}  // namespace
}  // namespace filigree::capi

using namespace filigree::capi;

filigree_error filigree_grids_get_triangles(const filigree_grids* grids, filigree_grid_triangle* to,
                                            size_t capacity, size_t* count, filigree_error_info* error) {
    return call(error, [&] {
        const filigree_grids& from = required(grids, "grids");
        fill(to, capacity, count, from.file.triangleCount(),
             [&](std::span<filigree_grid_triangle> room) { TriangleWriter(from, room).write(); });
    });
}

filigree_error filigree_grids_get_surface(const filigree_grids* grids, const filigree_hit* hit,
                                          filigree_surface* surface, filigree_error_info* error) {
    return call(error, [&] {
        const filigree_grids& from = required(grids, "grids");
        give(surfaceOf(from, hitOf(from, required(hit, "hit"))), surface, "surface");
    });
}
