// The C API gives what the C++ API gives.
#include "filigree/bake/bake.h"
#include "filigree/encoding/encode.h"
#include "filigree/grid/encode_grids.h"
#include "filigree/grid/heightfield.h"
#include "filigree/grid/lattice_choice.h"
#include "filigree/grid/rays.h"
#include "filigree/micromap/set.h"

#include "capi/samples.h"
#include "filigree.h"

#include <array>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

namespace filigree {
namespace {

// The leaf of samples.c as the rooms take it.
image::AlphaTexture leafTexture() {
    const filigree_image image = leafImage();
    std::vector<uint8_t> texels;
    for (size_t k = 0; k < size_t{leafSide} * leafSide; ++k)
        texels.push_back(static_cast<const uint8_t*>(image.texels)[4 * k]);
    return {image::alphaImageFrom8Bit(leafSide, leafSide, texels)};
}

std::vector<mesh::UvTriangle> leafUvTriangles() {
    const filigree_triangles from = leafTriangleList();
    std::vector<mesh::UvTriangle> triangles(from.triangle_count);
    for (size_t k = 0; k < 3 * triangles.size(); ++k) {
        const uint16_t vertex = static_cast<const uint16_t*>(from.indices)[k];
        triangles[k / 3].uv[k % 3] = {from.uvs[2 * vertex], from.uvs[2 * vertex + 1]};
    }
    return triangles;
}

bake::Baked bakedInCpp(unsigned states) {
    bake::Settings settings;
    if (states == 2) settings.format = micromap::Format::twoState;
    return *bake::bake(leafUvTriangles(), leafTexture(), image::AlphaTest{}, settings);
}

TEST(EqualToCpp, micromaps) {
    const filigree_image image = leafImage();
    const filigree_triangles triangles = leafTriangleList();
    for (const unsigned states : {2U, 4U}) {
        filigree_bake_settings settings = FILIGREE_BAKE_SETTINGS_INIT;
        settings.states = states;
        filigree_micromaps* maps = nullptr;
        ASSERT_EQ(filigree_bake(nullptr, &triangles, &image, nullptr, &settings, nullptr, &maps, nullptr),
                  FILIGREE_OK);
        std::vector<uint8_t> data(4096);
        std::vector<int32_t> indices(leafTriangles);
        size_t count = 0;
        ASSERT_EQ(filigree_micromaps_get_data(maps, data.data(), data.size(), &count, nullptr), FILIGREE_OK);
        data.resize(count);
        filigree_micromaps_get_indices(maps, 4, indices.data(), indices.size(), &count, nullptr);
        filigree_micromaps_destroy(maps);
        const auto flat = micromap::flatten(bakedInCpp(states).set);
        ASSERT_TRUE(flat);
        EXPECT_EQ(data, flat->data);
        EXPECT_EQ(indices, flat->indices);
    }
}

TEST(EqualToCpp, encodedSets) {
    const bake::Baked baked = bakedInCpp(4);
    std::vector<micromap::QuadtreeView> maps;
    for (size_t k = 0; k < baked.set.trees.size(); ++k) maps.push_back(baked.set.trees[k]);
    for (unsigned k = 0; k < encoding::encodingCount; ++k) {
        if (k == FILIGREE_ENCODING_BITMASK) continue;
        filigree_set* set = encodedLeaf(nullptr, static_cast<filigree_encoding>(k));
        filigree_set_blocks blocks = FILIGREE_SET_BLOCKS_INIT;
        ASSERT_EQ(filigree_set_get_blocks(set, &blocks, nullptr), FILIGREE_OK);
        const auto expected =
            encoding::encode(static_cast<encoding::Encoding>(k), maps, micromap::Format::fourState);
        ASSERT_TRUE(expected);
        EXPECT_EQ(std::vector(blocks.payload, blocks.payload + blocks.payload_bytes), expected->payload);
        EXPECT_EQ(std::vector(blocks.descriptors, blocks.descriptors + blocks.descriptor_bytes),
                  expected->descriptors);
        filigree_set_destroy(set);
    }
}

TEST(EqualToCpp, rays) {
    const filigree_heightfield heights = hillHeights();
    grid::GridMesh mesh = grid::gridOfHeights(hillSide, hillSide, 1, [&](uint32_t column, uint32_t row) {
        const auto height = static_cast<const uint16_t*>(heights.heights)[2 * (row * hillSide + column)];
        return static_cast<float>(height * heights.height_scale);
    });
    const auto lattice =
        grid::latticeMatchingPaper(mesh, grid::DisplacementCode::unitVector, serialExecutor());
    ASSERT_TRUE(lattice);
    grid::EncodeOptions options;
    options.lattice = lattice->lattice;
    const auto encoded = grid::encodeGrids(mesh, options);
    ASSERT_TRUE(encoded);
    grid::Tracer tracer(*encoded);

    filigree_grids* grids = gridsOfHills(nullptr);
    filigree_tracer* cTracer = nullptr;
    ASSERT_EQ(filigree_tracer_create(nullptr, grids, &cTracer, nullptr), FILIGREE_OK);
    for (unsigned k = 0; k < 400; ++k) {
        const grid::Ray ray{{static_cast<float>(k % 20) + 0.3F, 10, static_cast<float>(k) / 20},
                            {0.1F, -1, 0}};
        const grid::Hit expected = tracer.closest(ray);
        const filigree_ray cRay{{ray.origin[0], ray.origin[1], ray.origin[2]}, {0.1F, -1, 0}, 0, ray.tMax};
        filigree_hit hit;
        ASSERT_EQ(filigree_tracer_closest(cTracer, 1, &cRay, 0, &hit, 0, nullptr), FILIGREE_OK);
        EXPECT_EQ(hit.t, expected.t);
        EXPECT_EQ(hit.grid, expected.grid);
        EXPECT_EQ(hit.column, expected.column);
        EXPECT_EQ(hit.row, expected.row);
        EXPECT_EQ(hit.half, expected.half);
        EXPECT_EQ(hit.u, expected.u);
        EXPECT_EQ(hit.normal[1], expected.normal[1]);
    }
    filigree_tracer_destroy(cTracer);
    filigree_grids_destroy(grids);
}

}  // namespace
}  // namespace filigree
