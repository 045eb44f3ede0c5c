// One image of all textures with holes: what shaders read stays what it was.
#include "jobs/atlas.h"

#include "filigree/image/alpha_image.h"

#include "jobs/small_scene.h"

#include <gtest/gtest.h>

namespace filigree::jobs {
namespace {

using image::Wrap;

scene::Image noise(uint32_t width, uint32_t height, uint32_t seed) {
    std::vector<uint8_t> texels(size_t{width} * height);
    scene::ColourImage colour{width, height, {}};
    for (size_t k = 0; k < texels.size(); ++k) {
        texels[k] = static_cast<uint8_t>((k * 2654435761u + seed) >> 13);
        colour.rgba.insert(colour.rgba.end(), {1, static_cast<uint8_t>(k), 3, texels[k]});
    }
    return {"noise", image::alphaImageFrom8Bit(width, height, texels), std::move(colour)};
}

// Quads whose coordinates begin inside and far outside of the image, as each wrap mode has them.
scene::Scene scattered() {
    scene::Scene scene =
        tests::sceneOf({tests::masked(0), tests::masked(1), tests::masked(1), tests::masked(0)});
    scene.images = {noise(16, 16, 1), noise(24, 8, 2)};
    const std::array wraps{Wrap::repeat, Wrap::mirroredRepeat, Wrap::clampToEdge, Wrap::repeat};
    const std::array<mesh::Uv, 4> offsets{{{0, 0}, {-3.25F, 6.5F}, {-0.25F, -0.4F}, {17.5F, -8.75F}}};
    for (size_t m = 0; m < wraps.size(); ++m) {
        scene.materials[m].wrapU = scene.materials[m].wrapV = wraps[m];
        for (mesh::Uv& uv : scene.meshes[0].primitives[m].uvs)
            uv = {uv.u * 1.5F + offsets[m].u, uv.v + offsets[m].v};
    }
    return scene;
}

double alphaAt(const scene::Scene& scene, const scene::Primitive& primitive, size_t triangle, double a,
               double b) {
    const scene::Material& material = scene.materials[static_cast<size_t>(primitive.material)];
    const image::AlphaImage& alpha = *scene.images[static_cast<size_t>(material.image)].alpha;
    const mesh::UvTriangle t = primitive.uvTriangle(triangle);
    const auto mix = [&](float p, float q, float r) { return p + a * (double{q} - p) + b * (double{r} - p); };
    return image::sampleBilinear({alpha, material.wrapU, material.wrapV, material.filter},
                                 mix(t.uv[0].u, t.uv[1].u, t.uv[2].u) * alpha.width,
                                 mix(t.uv[0].v, t.uv[1].v, t.uv[2].v) * alpha.height);
}

TEST(Atlas, FiltersAsTheImagesDid) {
    const scene::Scene before = scattered();
    scene::Scene after = before;
    ASSERT_TRUE(packAtlas(after, 256).ok());
    ASSERT_EQ(after.images.size(), 3u);
    for (size_t m = 0; m < 4; ++m) {
        const auto& old = before.meshes[0].primitives[m];
        const auto& moved = after.meshes[0].primitives[m];
        ASSERT_EQ(after.materials[static_cast<size_t>(moved.material)].image, 2);
        ASSERT_EQ(moved.triangleCount(), old.triangleCount());
        for (size_t t = 0; t < 2; ++t) {
            for (double a = 0; a <= 1; a += 0.0625) {
                for (double b = 0; a + b <= 1; b += 0.0625)
                    EXPECT_NEAR(alphaAt(before, old, t, a, b), alphaAt(after, moved, t, a, b), 1e-3);
            }
        }
    }
}

TEST(Atlas, LeavesWhatDoesNotFit) {
    scene::Scene scene = scattered();
    for (mesh::Uv& uv : scene.meshes[0].primitives[0].uvs) uv.u *= 4;  // too many repeats
    scene.images[1].alpha->steps = 65535;
    const auto notes = packAtlas(scene, 64);
    ASSERT_TRUE(notes.ok());
    EXPECT_EQ(notes->back(),
              "atlas of 64 x 64 texels: 13.7 % filled, 2 triangles in it, 2 keep their own texture");
    EXPECT_EQ(scene.meshes[0].primitives[0].material, 0);
    EXPECT_EQ(scene.meshes[0].primitives[1].material, 1);

    scene = scattered();
    EXPECT_TRUE(packAtlas(scene, 20).ok());  // none finds a place
    for (int m = 0; m < 4; ++m) EXPECT_EQ(scene.meshes[0].primitives[static_cast<size_t>(m)].material, m);
    EXPECT_EQ(packAtlas(scene, 0).error().kind, ErrorKind::usage);
}

}  // namespace
}  // namespace filigree::jobs
