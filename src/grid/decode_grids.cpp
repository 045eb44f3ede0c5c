#include "filigree/grid/decode_grids.h"

#include "filigree/grid/cluster.h"
#include "filigree/grid/tile.h"

#include "grid/cluster_box.h"
#include "grid/record_spans.h"
#include "grid/sub_grids.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace filigree::grid {
namespace {

class GridDecoder {
  public:
    GridDecoder(const EncodedGrids& grids, std::span<const VertexGrid> table, DecodedGrids& to)
        : grids_(grids), table_(table), to_(to) {}

    void subGrid(const uint8_t* record) const {
        const PaperPlace place = paperPlace(record);
        const PaperVertices vertices = decodePaper(record, grids_.paper);
        const VertexGrid& grid = table_[place.grid];
        const unsigned columns = ownVertices(place.gridColumn, place.columns, place.gridColumns);
        const unsigned rows = ownVertices(place.gridRow, place.rows, place.gridRows);
        for (unsigned row = 0; row < rows; ++row) {
            std::copy_n(&vertices[row * paperSide], columns, &to_.vertices[vertexOf(grid, place, 0, row)]);
        }
    }

    void tile(const uint8_t* record) const {
        const Tile tile = decodeTile(record);
        const TilePlace& place = tile.place;
        const VertexGrid& grid = table_[place.grid];
        const unsigned columns = ownVertices(place.column, place.columns, grid.columns - 1);
        const unsigned rows = ownVertices(place.row, place.rows, grid.rows - 1);
        for (unsigned row = 0; row < rows; ++row) {
            const uint64_t first = grid.firstVertex + uint64_t{place.row + row} * grid.columns + place.column;
            for (unsigned column = 0; column < columns; ++column)
                to_.vertices[first + column] = grids_.lattice.positionOf(tile.at(column, row));
        }
    }

    void cluster(const uint8_t* record) const {
        const auto cluster = std::make_unique<ClusterTriangles>();
        decodeClusterPlain(record, *cluster);
        for (uint32_t t = 0; t < cluster->triangleCount; ++t) {
            for (size_t corner = 0; corner < 3; ++corner) {
                const LatticePoint p = clusterPoint(*cluster, cluster->corners[corner][t]);
                to_.looseTriangles[cluster->firstTriangle + t][corner] = grids_.lattice.positionOf(p);
            }
        }
    }

  private:
    const EncodedGrids& grids_;
    std::span<const VertexGrid> table_;
    DecodedGrids& to_;
};

}  // namespace

DecodedGrids decodeGrids(const EncodedGrids& grids, std::span<const VertexGrid> table,
                         uint32_t looseTriangles, const Executor& executor) {
    DecodedGrids decoded;
    decoded.vertices.resize(table.empty() ? 0 : table.back().firstVertex + table.back().vertexCount());
    decoded.looseTriangles.resize(looseTriangles);
    const GridDecoder decoder(grids, table, decoded);
    const RecordSpans spans(grids);
    executor.parallelFor(spans.count(), 64, [&](size_t begin, size_t end) {
        for (size_t k = begin; k < end; ++k) {
            const uint8_t* const record = grids.records.data() + spans.begin(k);
            if (spans.isCluster(k))
                decoder.cluster(record);
            else if (grids.codec == Codec::paper)
                decoder.subGrid(record);
            else
                decoder.tile(record);
        }
    });
    return decoded;
}

GridMesh decodedMesh(const EncodedGrids& grids, const GridMesh& mesh, const Executor& executor) {
    const auto looseCount = static_cast<uint32_t>(mesh.looseTriangles.size());
    DecodedGrids decoded = decodeGrids(grids, mesh.grids, looseCount, executor);
    GridMesh surface;
    surface.grids = mesh.grids;
    surface.diagonals = mesh.diagonals;
    surface.quadSources = mesh.quadSources;
    surface.looseSources = mesh.looseSources;
    surface.vertices = std::move(decoded.vertices);
    for (const auto& triangle : decoded.looseTriangles) {
        const auto first = static_cast<uint32_t>(surface.looseVertices.size());
        surface.looseTriangles.push_back({first, first + 1, first + 2});
        surface.looseVertices.insert(surface.looseVertices.end(), triangle.begin(), triangle.end());
    }
    return surface;
}

}  // namespace filigree::grid
