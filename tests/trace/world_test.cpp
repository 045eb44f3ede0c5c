// Scenes that no renderer likes to meet.
#include "trace/thicket.h"

#include <limits>

namespace filigree {
namespace {

constexpr float notANumber = std::numeric_limits<float>::quiet_NaN();

trace::Film pictureOf(const trace::World& world) {
    const auto texture = trace::Opacity::make(trace::Method::texture, 4, world, {}, {});
    trace::RenderSettings settings = tests::settingsFor(trace::Integrator::path, 16, 9);
    settings.camera = trace::overview(world, 16.0F / 9);
    EXPECT_TRUE(check(settings).ok());
    return tests::filmOf(world, *texture, settings, 1);
}

TEST(World, IsEmptyWithoutTriangles) {
    for (const bool withMesh : {false, true}) {
        scene::Scene scene;
        if (withMesh) {
            scene.meshes.push_back({"", {scene::Primitive{}}});
            scene.instances.emplace_back();
        }
        const auto world = trace::World::build(scene, {});
        ASSERT_TRUE(world.ok());
        EXPECT_EQ(world->triangleCount(), 0u);
        EXPECT_TRUE(world->bounds().empty());
        EXPECT_EQ(pictureOf(*world).pixelsHit, 0u);
    }
}

TEST(World, LeavesOutWhatIsNotFinite) {
    scene::Scene scene = tests::thicket();
    scene.instances[1].transform[13] = notANumber;
    scene.meshes[0].primitives[0].positions[2][1] = std::numeric_limits<float>::infinity();
    const auto world = trace::World::build(scene, {});
    ASSERT_TRUE(world.ok());
    ASSERT_EQ(world->notes().size(), 2u);
    EXPECT_THAT(world->notes()[0], testing::EndsWith("left out: 2"));
    EXPECT_THAT(world->notes()[1], testing::EndsWith("left out: 1"));
    EXPECT_LT(world->bounds().diagonal(), 40);
    const trace::Film film = pictureOf(*world);
    EXPECT_GT(film.pixelsHit, 0u);
    for (const Vec3& sum : film.sums) EXPECT_TRUE(std::isfinite(sum[0] + sum[1] + sum[2]));
}

TEST(World, BearsTransformsThatFlatten) {
    scene::Scene scene = tests::thicket();
    scene.instances[0].transform = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1};
    scene.instances[1].transform[0] = 1e30F;
    const auto world = trace::World::build(scene, {});
    ASSERT_TRUE(world.ok());
    for (const Vec3& sum : pictureOf(*world).sums) EXPECT_TRUE(std::isfinite(sum[0] + sum[1] + sum[2]));
}

TEST(World, TellsItsBytes) {
    const scene::Scene scene = tests::thicket();
    const auto world = trace::World::build(scene, {});
    const trace::World::Bytes bytes = world->bytes();
    EXPECT_EQ(bytes.geometry, 6u * 12 * (4 + 2));
    EXPECT_GE(bytes.textures, 32u * 32 + 21 * 40);
    EXPECT_GT(bytes.bvh, 0u);
    EXPECT_EQ(world->triangleCount(), 3u * 10 + 2);
    EXPECT_EQ(world->surfaceCount(), 6u);
}

TEST(World, MakesBlendOpaqueOnRequest) {
    const scene::Scene scene = tests::thicket();
    EXPECT_TRUE(trace::World::build(scene, {})->isTested(3));
    EXPECT_FALSE(trace::World::build(scene, {false})->isTested(3));
}

TEST(Opacity, RefusesIndicesThatDoNotFit) {
    scene::Scene scene = tests::thicket();
    const auto world = trace::World::build(scene, {});
    const auto maps = tests::mapsFor(scene, trace::Method::micromap, 4, 2);
    const auto input = jobs::makeOpacity(trace::Method::micromap, 4, scene, maps, *world, serialExecutor());
    const std::vector<int32_t> few{-1};
    const std::vector<int32_t> high{-1, 1000000};
    const std::vector<int32_t> low{-1, -5};
    for (const auto& indices : {few, high, low}) {
        std::vector<trace::SurfaceMaps> surfaces(world->surfaceCount());
        surfaces[0].indices = indices;
        const auto made =
            trace::Opacity::make(trace::Method::micromap, 4, *world, viewOf(input->set), surfaces);
        ASSERT_FALSE(made.ok());
        EXPECT_THAT(made.error().message, testing::HasSubstr("surface 0"));
    }
    EXPECT_FALSE(trace::Opacity::make(trace::Method::sdag, 4, *world, viewOf(input->set), {}).ok());
}

TEST(Opacity, RefusesSquaresThatDoNotFit) {
    const scene::Scene scene = tests::thicket();
    const auto world = trace::World::build(scene, {});
    const std::vector<uint8_t> blocks(2 * blockBytesOf(quadmap::SquareFormat::vq2));
    const auto reader = quadmap::SquareReader::open(quadmap::SquareFormat::vq2, blocks);
    struct Case {
        std::vector<int32_t> indices;
        std::vector<quadmap::SquarePlace> places;
    };
    for (const Case& wrong : {Case{{-1}, {{}}}, Case{{-1, 2}, {{}, {}}}, Case{{-5, 0}, {{}, {}}},
                              Case{{0, 1}, {{}}}, Case{{0, 1}, {{}, {quadmap::Half::first, 6}}}}) {
        const auto made =
            trace::Opacity::make(trace::Method::vq2, 4, *world, *reader, {{wrong.indices, wrong.places}});
        ASSERT_FALSE(made.ok());
        EXPECT_THAT(made.error().message, testing::HasSubstr("surface 0"));
    }
    EXPECT_FALSE(trace::Opacity::make(trace::Method::vq4, 4, *world, *reader, {}).ok());
    EXPECT_TRUE(trace::Opacity::make(trace::Method::vq2, 4, *world, *reader, {}).ok());
}

TEST(World, StopsWhenCancelled) {
    const scene::Scene scene = tests::thicket();
    const std::atomic<bool> stop = true;
    FunctionProgress progress(stop);
    const auto world = trace::World::build(scene, {}, progress);
    ASSERT_FALSE(world.ok());
    EXPECT_EQ(world.error().kind, ErrorKind::cancelled);

    uint64_t done = 0;
    FunctionProgress shown([&](const ProgressReport& report) { done = report.done; });
    ASSERT_TRUE(trace::World::build(scene, {}, shown).ok());
    EXPECT_GT(done, 0U);
}

}  // namespace
}  // namespace filigree
