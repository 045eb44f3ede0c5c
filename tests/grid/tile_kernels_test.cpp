// Every instruction set decodes tiles as the plain decoder does, to the bit.
#include "filigree/core/target.h"
#include "filigree/grid/tile.h"

#include "grid/ray_kernels.h"
#include "grid/some_tiles.h"
#include "grid/tile_boxes.h"
#include "grid/tile_order.h"

#include <algorithm>
#include <memory>

#include <gtest/gtest.h>

namespace filigree::grid {
namespace {

struct KernelCase {
    Tile tile;
    TileHeader head;
    std::vector<uint8_t> record;  // and slack
};

KernelCase kernelCase(const Tile& tile) {
    KernelCase made{tile, {}, {}};
    encodeTile(tile, made.record);
    made.head = loadTileHeader(made.record.data());
    made.record.resize(made.record.size() + EncodedGrids::recordSlack);
    return made;
}

// Both with the block's own steps; places in the patch that have none are skipped.
void expectSameBlock(const KernelCase& of, unsigned i, unsigned j, const Block& block) {
    const unsigned columns = of.head.columnsOf(i), rows = of.head.rowsOf(j);
    ASSERT_EQ(block.quads, stepMask(columns, rows));
    for (unsigned y = 0; y <= rows; ++y)
        for (unsigned x = 0; x <= columns; ++x) {
            const unsigned at = 5U * placesOfSteps[rows][y] + placesOfSteps[columns][x];
            for (unsigned k = 0; k < 3; ++k)
                ASSERT_EQ(static_cast<int32_t>(block.points[k][at]), of.tile.at(4 * i + x, 4 * j + y)[k])
                    << "block " << i << ", " << j << ", vertex " << x << ", " << y << ", axis " << k;
        }
    for (unsigned y = 0; y < rows; ++y)
        for (unsigned x = 0; x < columns; ++x) {
            const unsigned quad = 4U * (placesOfSteps[rows][y + 1] - 1) + placesOfSteps[columns][x + 1] - 1;
            ASSERT_EQ((block.bd >> quad & 1) != 0, of.tile.bd.test((4 * j + y) * 16 + 4 * i + x));
        }
}

void expectSameBox(const KernelCase& of, unsigned i, unsigned j, const TileBlocks& tile, unsigned place) {
    const uint8_t byte = of.record[tileHeaderBytes + j * of.head.blockColumns() + i];
    const LatticeBox box = widenedBox(cornerBox(of.tile, of.head, i, j), of.head, byte);
    for (unsigned k = 0; k < 3; ++k) {
        EXPECT_EQ(tile.low[k][place], static_cast<float>(std::max(box.low[k], 0)));
        EXPECT_EQ(tile.high[k][place], static_cast<float>(std::min(box.high[k], latticeLimit)));
    }
}

void expectSame(const RayKernels& kernels, const KernelCase& of) {
    const auto tile = std::make_unique<TileBlocks>();
    kernels.decodeTile(of.record.data(), *tile);
    const unsigned columns = of.head.blockColumns(), rows = of.head.blockRows();
    ASSERT_EQ(tile->blocks, stepMask(columns, rows));
    for (unsigned j = 0; j < rows; ++j)
        for (unsigned i = 0; i < columns; ++i) {
            const unsigned place = 4U * (placesOfSteps[rows][j + 1] - 1) + placesOfSteps[columns][i + 1] - 1;
            expectSameBox(of, i, j, *tile, place);
            Block block;
            kernels.decodeBlock(of.record.data(), *tile, place, block);
            ASSERT_NO_FATAL_FAILURE(expectSameBlock(of, i, j, block));
        }
}

// That the cases use what records can do.
void expectAllIsTried(const std::vector<KernelCase>& cases) {
    std::array<unsigned, 3> dominant{};
    std::array<unsigned, 4> drop{};
    unsigned curved = 0, sheared = 0, growing = 0, biased = 0;
    for (const KernelCase& of : cases) {
        ++dominant[of.head.dominant];
        for (unsigned block = 0; block < of.head.blocks(); ++block)
            ++drop[of.record[tileHeaderBytes + block] & 3];
        curved += of.head.curve != 0 ? 1 : 0;
        sheared += of.head.shear[0] != 0 && of.head.shear[1] != 0 ? 1 : 0;
        growing += of.head.shearColumn[0] != 0 && of.head.shearRow[1] != 0 ? 1 : 0;
        biased += of.head.bias[edgeMid] != evenBias ? 1 : 0;
    }
    EXPECT_THAT(dominant, testing::Each(testing::Gt(9U)));
    EXPECT_THAT(drop, testing::Each(testing::Gt(9U)));
    EXPECT_THAT((std::array{curved, sheared, growing, biased}), testing::Each(testing::Gt(9U)));
}

TEST(TileKernels, DecodeAsThePlainDecoder) {
    std::vector<KernelCase> cases;
    for (const TileSort sort : everyTileSort) {
        for (unsigned columns = 1; columns <= 16; ++columns)
            for (const unsigned rows : {1U, 2U, 3U, 4U, 7U, 10U, 13U, 16U})
                cases.push_back(kernelCase(someTile(sort, columns, rows, columns * 31 + rows)));
        for (uint32_t seed = 0; seed < 8; ++seed) cases.push_back(kernelCase(someTile(sort, 16, 16, seed)));
    }
    expectAllIsTried(cases);
    for (const char* target : {"scalar", "sse4", "avx2", "avx3"}) {
        if (!forceTarget(target)) continue;
        const RayKernels kernels = rayKernels();
        for (const KernelCase& of : cases) ASSERT_NO_FATAL_FAILURE(expectSame(kernels, of)) << target;
    }
    ASSERT_TRUE(forceTarget("best").ok() && forceTargetFromEnvironment().ok());
}

}  // namespace
}  // namespace filigree::grid
