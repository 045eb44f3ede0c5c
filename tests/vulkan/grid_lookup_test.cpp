// Vertices of tiles and clusters as the CPU's plain decoders give them, replayed on the device.
#include "filigree/vulkan/grid_lookup.h"

#include "filigree/bvh/build.h"
#include "filigree/grid/cluster.h"
#include "filigree/grid/record_boxes.h"
#include "filigree/grid/tile.h"

#include "grid/sample_grids.h"
#include "grid/some_tiles.h"
#include "vulkan/test_device.h"

#include <random>

namespace filigree::vulkan {
namespace {

using grid::EncodedGrids;

// Sanitizers make the decoders many times slower.
#if defined(__SANITIZE_ADDRESS__)
constexpr size_t vertexCount = 20'000;
constexpr unsigned sizeStep = 5;
#else
constexpr size_t vertexCount = 1'000'000;
constexpr unsigned sizeStep = 1;
#endif

class GridsInTheMaking {
  public:
    void add(const grid::Tile& tile) {
        addOffset(0);
        encodeTile(tile, made_.records);
    }
    void addCluster(const grid::GridMesh& mesh, uint32_t first, uint32_t count) {
        addOffset(EncodedGrids::clusterBit);
        appendCluster(mesh, first, count, {}, made_.records);
    }
    EncodedGrids take() {
        made_.records.resize(made_.records.size() + EncodedGrids::recordSlack);
        // Leaves must stand in the order of the records.
        const bvh::Bvh once = bvh::build(recordBoxes(made_, serialExecutor()), serialExecutor());
        EncodedGrids ordered = made_;
        ordered.records.clear();
        for (size_t k = 0; k < once.order.size(); ++k) append(once.order[k], ordered, k);
        ordered.records.resize(ordered.records.size() + EncodedGrids::recordSlack);
        ordered.nodes = once.nodes;
        return ordered;
    }

  private:
    void addOffset(uint32_t mark) {
        made_.offsets.push_back(static_cast<uint32_t>(made_.records.size() / EncodedGrids::recordUnit) |
                                mark);
    }
    [[nodiscard]] size_t begin(size_t k) const {
        if (k == made_.offsets.size()) return made_.records.size() - EncodedGrids::recordSlack;
        return size_t{made_.offsets[k] & ~EncodedGrids::clusterBit} * EncodedGrids::recordUnit;
    }
    void append(size_t k, EncodedGrids& to, size_t place) const {
        to.offsets[place] = static_cast<uint32_t>(to.records.size() / EncodedGrids::recordUnit) |
                            (made_.offsets[k] & EncodedGrids::clusterBit);
        const auto from = made_.records.begin();
        to.records.insert(to.records.end(), from + static_cast<ptrdiff_t>(begin(k)),
                          from + static_cast<ptrdiff_t>(begin(k + 1)));
    }

    EncodedGrids made_;
};

// Tiles of all sorts and sizes; the last blocks of many are smaller, and axes have fields without bits.
void addTiles(GridsInTheMaking& to) {
    for (const grid::TileSort sort : grid::everyTileSort)
        for (unsigned columns = 1; columns <= 16; columns += sizeStep)
            for (unsigned rows = 1; rows <= 16; rows += sizeStep)
                to.add(someTile(sort, columns, rows, 100 * columns + rows));
}

// From single triangles to full clusters, nearly plane or anywhere on the lattice.
void addClusters(GridsInTheMaking& to) {
    std::mt19937 random(9);
    for (unsigned k = 0; k < 200; ++k) {
        grid::GridMesh mesh;
        const uint32_t range = 2u << (random() % 24);
        const auto vertices = static_cast<uint32_t>(3 + random() % 60);
        for (uint32_t v = 0; v < vertices; ++v) {
            const auto x = static_cast<float>(random() % range), z = static_cast<float>(random() % range);
            const auto y = k % 2 == 0 ? static_cast<float>(random() % range) : std::floor((x + z) / 3);
            mesh.looseVertices.push_back({x, y, z});
        }
        const auto triangles = static_cast<uint32_t>(1 + random() % grid::maxClusterTriangles);
        for (uint32_t t = 0; t < triangles; ++t) {
            // Strips that begin anew now and then, so that there are edges to take from the stack.
            const uint32_t first = t % 7 == 0 ? static_cast<uint32_t>(random()) : t;
            mesh.looseTriangles.push_back({first % vertices, (first + 1) % vertices, (first + 2) % vertices});
        }
        to.addCluster(mesh, 0, triangles);
    }
}

// What the plain decoders give.
class PlainVertices {
  public:
    explicit PlainVertices(const EncodedGrids& grids) : grids_(grids) {
        for (size_t k = 0; k < grids.offsets.size(); ++k) {
            numbers_.push_back(static_cast<uint32_t>(isCluster(k) ? clusters_.size() : tiles_.size()));
            if (isCluster(k)) {
                decodeClusterPlain(record(k), clusters_.emplace_back());
            } else {
                tiles_.push_back(grid::decodeTile(record(k)));
            }
        }
    }
    [[nodiscard]] GridPlace somePlace(std::mt19937& random) const {
        const auto record = static_cast<uint32_t>(random() % numbers_.size());
        const auto below = [&](uint32_t count) { return static_cast<uint32_t>(random() % count); };
        if (isCluster(record)) return {record, below(clusters_[numbers_[record]].triangleCount), below(3)};
        const grid::TilePlace& place = tiles_[numbers_[record]].place;
        return {record, below(place.columns + 1), below(place.rows + 1)};
    }
    [[nodiscard]] GridVertex at(const GridPlace& place) const {
        if (isCluster(place.record)) {
            const auto& cluster = clusters_[numbers_[place.record]];
            const uint8_t v = cluster.corners[place.row][place.column];
            return {{cluster.vertices[0][v], cluster.vertices[1][v], cluster.vertices[2][v]}, false};
        }
        const grid::Tile& tile = tiles_[numbers_[place.record]];
        const bool isQuad = place.column < tile.place.columns && place.row < tile.place.rows;
        return {tile.at(place.column, place.row), isQuad && tile.bd.test(place.row * 16 + place.column)};
    }

  private:
    [[nodiscard]] bool isCluster(size_t k) const {
        return (grids_.offsets[k] & EncodedGrids::clusterBit) != 0;
    }
    [[nodiscard]] const uint8_t* record(size_t k) const {
        return grids_.records.data() +
               size_t{grids_.offsets[k] & ~EncodedGrids::clusterBit} * EncodedGrids::recordUnit;
    }

    const EncodedGrids& grids_;
    std::vector<grid::Tile> tiles_;
    std::vector<grid::ClusterTriangles> clusters_;
    std::vector<uint32_t> numbers_;
};

EncodedGrids encodedBox(uint32_t side, grid::Codec codec) {
    grid::GridMesh mesh = grid::tests::mixedBox(side);
    return grid::tests::encoded(mesh, grid::tests::optionsFor(mesh, codec));
}

class VulkanGridLookup : public tests::VulkanTest {};

void expectPlainVertices(const Device& device, const EncodedGrids& grids, size_t count) {
    const PlainVertices plain(grids);
    std::mt19937 random(3);
    std::vector<GridPlace> places(count);
    for (GridPlace& place : places) place = plain.somePlace(random);
    const auto found = lookup(device, grids, places);
    ASSERT_TRUE(found.ok()) << found.error().message;
    ASSERT_EQ(found->size(), count);
    size_t wrong = 0;
    for (size_t k = 0; k < count; ++k) {
        const GridVertex right = plain.at(places[k]);
        const GridVertex& vertex = (*found)[k];
        if (vertex == right) continue;
        if (++wrong > 4) continue;
        ADD_FAILURE() << "record " << places[k].record << " at " << places[k].column << ", " << places[k].row
                      << ": device " << testing::PrintToString(vertex.point) << ", CPU "
                      << testing::PrintToString(right.point);
    }
    EXPECT_EQ(wrong, 0u) << "of " << count;
}

TEST_F(VulkanGridLookup, DecodesTilesAsThePlainDecoder) {
    GridsInTheMaking grids;
    addTiles(grids);
    expectPlainVertices(*device_, grids.take(), vertexCount);
}

TEST_F(VulkanGridLookup, DecodesClustersAsThePlainDecoder) {
    GridsInTheMaking grids;
    addClusters(grids);
    expectPlainVertices(*device_, grids.take(), vertexCount / 5);
}

TEST_F(VulkanGridLookup, DecodesEncodedMeshes) {
    expectPlainVertices(*device_, encodedBox(37, grid::Codec::lattice), vertexCount / 10);
}

TEST_F(VulkanGridLookup, RefusesWhatHasNoShader) {
    const auto found = lookup(*device_, encodedBox(9, grid::Codec::paper), {});
    ASSERT_FALSE(found.ok());
    EXPECT_EQ(found.error().kind, ErrorKind::unsupported);
}

TEST_F(VulkanGridLookup, ChecksTheGrids) {
    EncodedGrids grids = encodedBox(9, grid::Codec::lattice);
    grids.records.resize(grids.records.size() - EncodedGrids::recordUnit);
    const auto found = lookup(*device_, grids, {});
    ASSERT_FALSE(found.ok());
    EXPECT_EQ(found.error().kind, ErrorKind::format);
}

}  // namespace
}  // namespace filigree::vulkan
