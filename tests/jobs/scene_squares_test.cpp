// Encoded squares of scenes against the alpha that they stand for.
#include "jobs/scene_squares.h"

#include "jobs/scene_pairs.h"
#include "jobs/small_scene.h"

#include <random>

#include <gtest/gtest.h>

namespace filigree::jobs {
namespace {

// A fan of triangles around the middle of a disc, with a single triangle beside it.
scene::Scene fanScene() {
    scene::Scene scene = tests::sceneOf({tests::masked(0)});
    std::vector<uint8_t> texels(64 * 64);
    for (size_t i = 0; i < texels.size(); ++i) {
        const double x = static_cast<double>(i % 64) - 31.5;
        const double y = static_cast<double>(i / 64) - 31.5;
        texels[i] = x * x + 2 * y * y < 600 ? 255 : 0;
    }
    scene.images[0].alpha = image::alphaImageFrom8Bit(64, 64, texels);
    scene::Primitive& fan = scene.meshes[0].primitives[0];
    fan.positions = {{1, 1, 0}, {0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {9, 9, 0}, {8, 9, 0}, {9, 8, 0}};
    fan.uvs = {{0.5F, 0.5F}, {0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.2F, 0.2F}, {0.9F, 0.4F}, {0.4F, 0.9F}};
    fan.indices = {0, 1, 2, 2, 3, 0, 0, 3, 4, 0, 1, 4, 5, 6, 7};  // one wound the other way
    return scene;
}

// What a lookup says of a triangle at the weights of its vertices.
quadmap::Region lookup(const SceneSquares& squares, const quadmap::SquareReader& reader, size_t triangle,
                       const std::array<double, 3>& weights) {
    const int32_t index = squares.indices[triangle];
    if (index == -1) return quadmap::Region::transparent;
    if (index == -2) return quadmap::Region::opaque;
    if (index < 0) return quadmap::Region::mixed;
    const quadmap::SquarePlace place = squares.places[triangle];
    const auto vertices = quadmap::verticesOf(place);
    return reader.at(static_cast<size_t>(index), place.half, static_cast<float>(weights[vertices[1]]),
                     static_cast<float>(weights[vertices[2]]));
}

double alphaAt(const scene::Scene& scene, size_t triangle, const std::array<double, 3>& weights) {
    const mesh::UvTriangle t = scene.meshes[0].primitives[0].uvTriangle(triangle);
    double x = 0;
    double y = 0;
    for (size_t k = 0; k < 3; ++k) {
        x += 64 * weights[k] * t.uv[k].u;
        y += 64 * weights[k] * t.uv[k].v;
    }
    return image::sampleBilinear({*scene.images[0].alpha}, x, y);
}

TEST(SceneSquares, LookupsAgreeWithTheAlpha) {
    const scene::Scene scene = fanScene();
    std::mt19937 random(4);
    const auto unit = [&] { return static_cast<double>(random() >> 8) * 0x1p-24; };
    for (const char* name : {"vq2", "vq2+", "vq4", "vq4+"}) {
        const auto format = squareFormatNamed(name);
        ASSERT_TRUE(format);
        const auto squares =
            encodeSquares(scene, pairGroups(scene, {}), *format, serialExecutor(), silentProgress());
        ASSERT_TRUE(squares);
        ASSERT_EQ(squares->indices.size(), 5u);
        const auto reader = quadmap::SquareReader::open(*format, squares->blocks);
        ASSERT_TRUE(reader);
        size_t known = 0;
        for (int sample = 0; sample < 20000; ++sample) {
            const double u = unit();
            const double v = unit() * (1 - u);
            const std::array<double, 3> weights{1 - u - v, u, v};
            const size_t triangle = random() % 5;
            const quadmap::Region region = lookup(*squares, *reader, triangle, weights);
            if (!quadmap::isKnown(region)) continue;
            ++known;
            ASSERT_EQ(region == quadmap::Region::opaque, alphaAt(scene, triangle, weights) >= 0.5)
                << name << ", triangle " << triangle;
        }
        EXPECT_GT(known, 10000u) << name;
    }
}

TEST(SceneSquares, UniformHalvesNeedNoBlock) {
    scene::Scene scene = tests::sceneOf({tests::masked(0)});
    scene::Primitive& quad = scene.meshes[0].primitives[0];
    for (mesh::Uv& uv : quad.uvs) uv.u = 0.25F + uv.u / 8;  // the opaque half alone
    const auto squares = encodeSquares(scene, pairGroups(scene, {}), quadmap::SquareFormat::vq2,
                                       serialExecutor(), silentProgress());
    ASSERT_TRUE(squares);
    EXPECT_EQ(squares->maps(), 0u);
    EXPECT_EQ(squares->indices, (std::vector<int32_t>{-2, -2}));
}

}  // namespace
}  // namespace filigree::jobs
