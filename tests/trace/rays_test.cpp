// Rays that are cast again, and texels among colours.
#include "filigree/trace/rays.h"

#include "filigree/image/alpha_image.h"

#include "trace/random.h"
#include "trace/sampler.h"
#include "trace/thicket.h"

#include <gtest/gtest.h>

namespace filigree {
namespace {

using image::Wrap;

image::AlphaTexture noise(uint32_t width, uint32_t height) {
    image::AlphaTexture texture{{width, height, {}, 255}};
    for (uint32_t k = 0; k < width * height; ++k)
        texture.image.texels.push_back(static_cast<uint16_t>(257 * (trace::hashed(k) % 256)));
    return texture;
}

// Alpha, behind three other bytes.
scene::ColourImage coloured(const image::AlphaImage& alpha) {
    scene::ColourImage image{alpha.width, alpha.height, {}};
    for (const uint16_t texel : alpha.texels) {
        image.rgba.insert(image.rgba.end(), {1, 2, 3});
        image.rgba.push_back(static_cast<uint8_t>(texel / 257));
    }
    return image;
}

// Sizes of one texel, powers of two and others; near, on borders, and 2^33 texels away.
TEST(Sampler, ReadsBytesAloneAndAmongColoursAlike) {
    trace::RandomStream random(4, 5, 6);
    for (const auto& [width, height] : {std::pair{1u, 1u}, {1u, 6u}, {8u, 4u}, {64u, 3u}, {21u, 32u}}) {
        image::AlphaTexture texture = noise(width, height);
        const scene::ColourImage colours = coloured(texture.image);
        for (const auto wrap : {Wrap::repeat, Wrap::mirroredRepeat, Wrap::clampToEdge}) {
            for (const auto filter : {image::Filter::linear, image::Filter::nearest}) {
                texture.wrapU = wrap;
                texture.wrapV = Wrap::repeat;
                texture.filter = filter;
                const trace::Sampler alone(texture);
                const trace::Sampler among(texture, colours);
                EXPECT_EQ(among.bytes(), 4 * alone.bytes());
                for (int k = 0; k < 600; ++k) {
                    const double far = k % 3 == 0 ? 1 : k % 3 == 1 ? 40 : 8589934592.0 / width;
                    double u = (2.0 * random.next() - 1) * far;
                    double v = 6.0 * random.next() - 3;
                    if (k % 5 == 0) u = std::round(u * 2 * width) / (2 * width);
                    if (k % 7 == 0) v = std::round(v * 2 * height) / (2 * height);
                    const double wanted = filter == image::Filter::linear
                                              ? image::sampleBilinear(texture, u * width, v * height)
                                              : image::sampleNearest(texture, u * width, v * height);
                    EXPECT_EQ(alone.at(u, v), wanted) << width << " x " << height << ": " << u << ", " << v;
                    EXPECT_EQ(among.at(u, v), wanted);
                }
            }
        }
    }
}

trace::RenderSettings settingsFor(const trace::World& world, trace::Integrator integrator) {
    trace::RenderSettings settings;
    settings.width = 40;
    settings.height = 24;
    settings.integrator = integrator;
    settings.camera = trace::overview(world, 40.0F / 24);
    return settings;
}

TEST(Rays, CostWhatTheyCostInTheirPicture) {
    scene::Scene scene = tests::thicket();
    for (scene::Image& image : scene.images) image.colour = coloured(*image.alpha);
    const auto world = trace::World::build(scene, {});
    const auto colours = trace::World::build(scene, {true, true});
    ASSERT_TRUE(world.ok() && colours.ok());
    const auto texture = trace::Opacity::make(trace::Method::texture, 4, *world, {}, {});
    const auto among = trace::Opacity::make(trace::Method::texture, 4, *colours, {}, {});
    ASSERT_TRUE(texture.ok() && among.ok());
    EXPECT_EQ(texture->bytes(), 0u);
    for (const auto integrator : {trace::Integrator::primary, trace::Integrator::shadow,
                                  trace::Integrator::ao, trace::Integrator::path}) {
        const auto settings = settingsFor(*world, integrator);
        trace::Film film(settings.width, settings.height);
        ASSERT_TRUE(addSample(*world, *texture, settings, serialExecutor(), silentProgress(), film));
        const auto rays = raysOf(*world, *texture, settings);
        trace::Counters counters;
        const auto found = castRays(*world, *texture, rays, true, counters);
        for (const auto kind :
             {trace::RayKind::primary, trace::RayKind::shadow, trace::RayKind::ao, trace::RayKind::bounce}) {
            EXPECT_EQ(counters[kind].rays, film.counters[kind].rays);
            EXPECT_EQ(counters[kind].candidateHits, film.counters[kind].candidateHits);
            EXPECT_EQ(counters[kind].textureFetches, film.counters[kind].textureFetches);
            EXPECT_EQ(counters[kind].bitsRead, 0u);
        }
        EXPECT_GT(found.hits, 0u);
        EXPECT_EQ(castRays(*colours, *among, rays, false, counters).hash, found.hash);
        const auto candidates = candidateHits(*world, rays);
        EXPECT_EQ(candidates.size(), film.counters.total().candidateHits);
        for (const auto& c : candidates) {
            ASSERT_LT(c.surface, world->surfaceCount());
            ASSERT_LT(c.triangle, world->primitive(c.surface).triangleCount());
            EXPECT_TRUE(world->isTested(c.surface));
        }
    }
}

// A single triangle leaves the other half of its square free, which encoders may fill with anything. The
// corners where regions of both halves meet belong to the triangle all the same.
TEST(Rays, HitSquaresOnTheSharedEdgeAsTheTextureDoes) {
    scene::Scene scene = tests::thicket();
    for (const bool second : {false, true}) {
        scene::Primitive half;
        half.material = 0;
        half.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
        half.uvs = {{0.1F, 0.2F}, {0.9F, 0.3F}, {0.2F, 0.8F}};
        half.indices = second ? std::vector<uint32_t>{2, 1, 0} : std::vector<uint32_t>{0, 1, 2};
        scene.meshes = {{"half", {half}}};
        scene.instances = {{0, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}};
        const auto world = trace::World::build(scene, {});
        std::vector<trace::Ray> rays;
        for (unsigned k = 0; k <= 64; ++k) {
            const float x = static_cast<float>(k) / 64;
            for (const float y : {1 - x, (1 - x) / 2, 0.0F})
                rays.push_back({{x, y, 1}, {0, 0, -1}, 2, 0, {}});
        }
        const auto texture = trace::Opacity::make(trace::Method::texture, 4, *world, {}, {});
        trace::Counters counters;
        const auto expected = castRays(*world, *texture, rays, false, counters);
        EXPECT_GT(expected.hits, 20u);
        EXPECT_LT(expected.hits, counters.total().candidateHits);
        for (const auto method : tests::methodsWithStates) {
            const auto input = tests::inputFor(scene, *world, method, 4, 4);
            EXPECT_EQ(castRays(*world, *input->opacity, rays, true, counters).hash, expected.hash)
                << nameOf(method);
        }
    }
}

}  // namespace
}  // namespace filigree
