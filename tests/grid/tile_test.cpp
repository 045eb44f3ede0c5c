// The page docs/spec/lattice.md: every tile comes back as it was, and nothing broken is accepted.
#include "filigree/grid/tile.h"

#include "filigree/grid/lattice_choice.h"
#include "filigree/grid/shapes.h"

#include "grid/some_tiles.h"
#include "grid/tile_boxes.h"
#include "grid/tile_layout.h"
#include "grid/tile_order.h"

#include <cmath>
#include <memory>

#include <gtest/gtest.h>

namespace filigree::grid {
namespace {

std::vector<uint8_t> encoded(const Tile& tile) {
    std::vector<uint8_t> record;
    encodeTile(tile, record);
    return record;
}

void expectRoundTrip(const Tile& tile) {
    const std::vector<uint8_t> record = encoded(tile);
    ASSERT_EQ(record.size() % 8, 0U);
    const auto size = checkTile(record);
    ASSERT_TRUE(size.ok()) << size.error().message;
    EXPECT_EQ(*size, record.size());
    EXPECT_EQ(tileBytes(record.data()), record.size());
    EXPECT_EQ(tilePlace(record.data()), tile.place);
    EXPECT_TRUE(decodeTile(record.data()) == tile)
        << tile.place.columns << " x " << tile.place.rows << " quads";
}

TEST(Tile, ComesBackAtEverySize) {
    for (unsigned columns = 1; columns <= 16; ++columns)
        for (unsigned rows = 1; rows <= 16; ++rows)
            for (const TileSort sort : everyTileSort)
                ASSERT_NO_FATAL_FAILURE(expectRoundTrip(someTile(sort, columns, rows, columns * 17 + rows)));
}

TEST(Tile, ComesBackFromAnyCoordinates) {
    for (uint32_t seed = 0; seed < 50; ++seed)
        for (const TileSort sort : everyTileSort)
            ASSERT_NO_FATAL_FAILURE(expectRoundTrip(someTile(sort, 16, 16, seed)));
}

TEST(Tile, KeepsItsPlaceAtTheLimits) {
    Tile tile = someTile(TileSort::smooth, 3, 5, 1);
    tile.place.grid = (1U << 24) - 1;
    tile.place.column = 0xfff0;
    tile.place.row = 0xfff0;
    expectRoundTrip(tile);
}

TEST(Tile, StoresDiagonalsOnlyWhereTheyDiffer) {
    Tile tile = someTile(TileSort::flat, 16, 13, 1);
    tile.bd.reset();
    const size_t least = encoded(tile).size();
    for (unsigned row = 0; row < 13; ++row)
        for (unsigned column = 0; column < 16; ++column) tile.bd.set(row * 16 + column);
    expectRoundTrip(tile);
    EXPECT_EQ(encoded(tile).size(), least);
    tile.bd.reset(12 * 16 + 15);
    expectRoundTrip(tile);
    EXPECT_EQ(encoded(tile).size(), least + 32);
}

TEST(Tile, OfARegularSheetIsLittleMoreThanItsHeader) {
    // 16 quads each way and no height: corners of 6 bits twice.
    EXPECT_LE(encoded(someTile(TileSort::flat, 16, 16, 0)).size(), 64U);
}

// Bytes a triangle of all tiles at an RMS of `share` of the diagonal.
double bytesPerTriangle(const GridMesh& mesh, double share) {
    const double diagonal = std::hypot(1.0, 1.0);
    const auto lattice = latticeForRms(mesh, share * diagonal, serialExecutor());
    EXPECT_TRUE(lattice.ok());
    std::vector<uint8_t> records;
    for (uint32_t grid = 0; grid < mesh.grids.size(); ++grid)
        for (const TilePlace& place : tilesOf(mesh.grids[grid], grid))
            encodeTile(snapTile(mesh, *lattice, place), records);
    return static_cast<double>(records.size()) / static_cast<double>(2 * mesh.quadCount());
}

TEST(Tile, IsAsSmallAsItWas) {
    EXPECT_LE(bytesPerTriangle(terrain(257, serialExecutor()), 2e-6), 0.803);
    EXPECT_LE(bytesPerTriangle(torus(257, serialExecutor()), 2e-5), 1.227);
    EXPECT_LE(bytesPerTriangle(box(64, serialExecutor()), 2e-5), 1.242);
}

TEST(Tile, HasPartsWhereThePageSays) {
    for (unsigned columns = 1; columns <= 16; ++columns)
        for (unsigned rows = 1; rows <= 16; ++rows) {
            const TileHeader head =
                loadTileHeader(encoded(someTile(TileSort::rough, columns, rows, 5)).data());
            const TileParts parts = tileParts(head);
            std::array<uint32_t, residualClasses> count{};
            uint32_t coarse = 0;
            walkCoarse(head, [&](unsigned, unsigned) { ++coarse; });
            walkFine(head, [&](ResidualClass c, unsigned, unsigned, unsigned) { ++count[c]; });
            EXPECT_EQ(coarse, coarseVertices(head));
            EXPECT_EQ(parts.edgeQuarters - parts.edgeMids, count[edgeMid] * vertexBits(head, edgeMid, 0));
            EXPECT_EQ(parts.insides - parts.edgeQuarters,
                      count[edgeQuarter] * vertexBits(head, edgeQuarter, 0));
            EXPECT_EQ(4 + coarse + count[0] + count[1] + count[2] + count[3] + count[4],
                      (columns + 1) * (rows + 1));
        }
}

TEST(Tile, HasHeaderFieldsWhereThePageSays) {
    std::vector<uint8_t> bytes(tileHeaderBytes);
    for (size_t k = 0; k < bytes.size(); ++k) bytes[k] = static_cast<uint8_t>(37 * k + 11);
    bytes[7] &= 0x7f;
    for (const size_t k : {23, 27, 31, 35}) bytes[k] &= 0x3f;
    std::vector<uint8_t> again(tileHeaderBytes);
    storeTileHeader(again.data(), loadTileHeader(bytes.data()));
    EXPECT_EQ(again, bytes);
    const TileHeader head = loadTileHeader(bytes.data());
    EXPECT_EQ(head.grid, 0x55300bU);
    EXPECT_EQ(head.columns, 1U + 0xa);
    EXPECT_EQ(head.rows, 1U + 7);
}

TEST(TileBoxes, HoldTheirBlocksAndAreNotMuchLarger) {
    // Each side of a box reaches out at most 1/7 of the tile's greatest reach too far, rounded up.
    for (const TileSort sort : everyTileSort) {
        const Tile tile = someTile(sort, 16, 15, 3);
        const std::vector<uint8_t> record = encoded(tile);
        const TileHeader head = loadTileHeader(record.data());
        const auto unit = static_cast<int32_t>(reachUnit(head.reach[head.dominant]));
        for (unsigned block = 0; block < head.blocks(); ++block) {
            const unsigned i = block % 4, j = block / 4;
            const LatticeBox box =
                widenedBox(cornerBox(tile, head, i, j), head, record[tileHeaderBytes + block]);
            const LatticeBox exact = vertexBox(tile, head, i, j);
            for (unsigned k = 0; k < 3; ++k) {
                EXPECT_LE(box.low[k], exact.low[k]);
                EXPECT_GE(box.high[k], exact.high[k]);
            }
            EXPECT_LE(exact.low[head.dominant] - box.low[head.dominant], unit);
            EXPECT_LE(box.high[head.dominant] - exact.high[head.dominant], unit);
        }
    }
}

TEST(TileChecks, RefuseEveryPrefix) {
    for (const TileSort sort : everyTileSort) {
        const std::vector<uint8_t> record = encoded(someTile(sort, 14, 9, 7));
        for (size_t size = 0; size < record.size(); ++size) {
            // Its own allocation, so that a read behind it is seen.
            const auto prefix = std::make_unique<uint8_t[]>(size);
            std::copy_n(record.begin(), size, prefix.get());
            EXPECT_FALSE(checkTile({prefix.get(), size}).ok()) << size;
        }
    }
}

TEST(TileChecks, TakeOneRecordOfMany) {
    std::vector<uint8_t> records = encoded(someTile(TileSort::rough, 14, 9, 7));
    const size_t first = records.size();
    encodeTile(someTile(TileSort::smooth, 2, 2, 7), records);
    EXPECT_EQ(*checkTile(records), first);
    EXPECT_EQ(*checkTile(std::span(records).subspan(first)), records.size() - first);
}

struct BrokenTile {
    const char* what;
    size_t byte;
    uint8_t mask;
    uint8_t value;
};

TEST(TileChecks, NameWhatIsWrong) {
    const std::vector<uint8_t> good = encoded(someTile(TileSort::rough, 6, 7, 2));
    for (const BrokenTile& broken :
         {BrokenTile{"reserved", 7, 0x80, 0x80}, BrokenTile{"reserved", 23, 0x40, 0x40},
          BrokenTile{"reserved", 35, 0x80, 0x80}, BrokenTile{"dominant", 7, 0x0c, 0x0c},
          BrokenTile{"diagonals", 7, 0x03, 0x03}, BrokenTile{"reach", 11, 0xff, 23 * 8},
          BrokenTile{"wide", 20, 0x1f, 25}, BrokenTile{"wide", 32, 0x1f, 31}}) {
        std::vector<uint8_t> record = good;
        record[broken.byte] = static_cast<uint8_t>((record[broken.byte] & ~broken.mask) | broken.value);
        const auto size = checkTile(record);
        ASSERT_FALSE(size.ok()) << broken.what;
        EXPECT_THAT(size.error().message, testing::HasSubstr(broken.what));
    }
}

TEST(TileChecks, RefuseBoxesThatAreTooSmall) {
    std::vector<uint8_t> record = encoded(someTile(TileSort::rough, 8, 8, 2));
    for (unsigned block = 0; block < 4; ++block) record[tileHeaderBytes + block] &= 3;
    ASSERT_FALSE(checkTile(record).ok());
    EXPECT_THAT(checkTile(record).error().message, testing::HasSubstr("box"));
}

TEST(TileChecks, AcceptWhatDecodesWithinTheLattice) {
    // Whatever the fields say, coordinates wrap around.
    std::vector<uint8_t> record = encoded(someTile(TileSort::noise, 16, 16, 9));
    const size_t begin = tileParts(loadTileHeader(record.data())).bits;
    for (size_t at = begin; at + 8 < record.size(); ++at) record[at] = static_cast<uint8_t>(at * 89);
    const Tile tile = decodeTile(record.data());
    for (const LatticePoint& point : tile.points)
        for (const int32_t coordinate : point) {
            EXPECT_GE(coordinate, 0);
            EXPECT_LT(coordinate, latticeLimit);
        }
}

TEST(Tiles, CoverTheirGridOnce) {
    for (const auto& [columns, rows] : {std::pair{2U, 2U}, {17U, 17U}, {18U, 33U}, {100U, 3U}}) {
        std::vector<int> covered(size_t{columns - 1} * (rows - 1));
        for (const TilePlace& place : tilesOf({columns, rows, 0, 0}, 7)) {
            EXPECT_EQ(place.grid, 7U);
            EXPECT_EQ(place.column % 16 + place.row % 16, 0U);
            for (unsigned y = 0; y < place.rows; ++y)
                for (unsigned x = 0; x < place.columns; ++x)
                    ++covered[(place.row + y) * (columns - 1) + place.column + x];
        }
        EXPECT_EQ(covered, std::vector<int>(covered.size(), 1));
    }
}

TEST(Tiles, AreSnappedFromTheirPartOfTheGrid) {
    GridMesh mesh;
    mesh.grids = {{3, 2, 0, 0}, {20, 18, 6, 2}};
    mesh.vertices.assign(6, Vec3{});
    for (unsigned row = 0; row < 18; ++row)
        for (unsigned column = 0; column < 20; ++column)
            mesh.vertices.push_back({static_cast<float>(column), static_cast<float>(row) / 2, 3.6F});
    mesh.diagonals.assign(2 + 19 * 17, Diagonal::ac);
    mesh.diagonals[2 + 16 * 19 + 18] = Diagonal::bd;
    const Lattice lattice{{-1, 0, 0}, {1, 0.5, 1}};
    const Tile tile = snapTile(mesh, lattice, {1, 16, 16, 3, 1});
    EXPECT_EQ(tile.at(0, 0), (LatticePoint{17, 16, 4}));
    EXPECT_EQ(tile.at(3, 1), (LatticePoint{20, 17, 4}));
    EXPECT_EQ(tile.bd.count(), 1U);
    EXPECT_TRUE(tile.bd.test(2));
    EXPECT_EQ(tile.box(), (Box{{17, 16, 4}, {20, 17, 4}}));
}

}  // namespace
}  // namespace filigree::grid
