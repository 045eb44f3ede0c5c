// Real scenes look the same with every method.
#include "filigree/io/gltf.h"

#include "shared_data.h"
#include "trace/thicket.h"

#include <cstdlib>
#include <string>

#include <fmt/format.h>

namespace filigree {
namespace {

class SharedScenes : public testing::TestWithParam<std::string> {};

// Squares whose encoding or comparing takes long.
bool isLong(const std::string& file, trace::Method method) {
    if (!jobs::readsSquares(method) || file == "sh3d_nets_and_plants.glb") return false;
    return file == "crytek_sponza.glb" || method != trace::Method::vq2;
}

TEST_P(SharedScenes, LookTheSameToTheBitWithEveryMethodOfFourStates) {
    FILIGREE_NEEDS_SHARED_DATA();
    const bool full = std::getenv("FILIGREE_FULL") != nullptr;
    const auto document = io::GltfDocument::load(tests::sharedData() / "data/scenes" / GetParam());
    ASSERT_TRUE(document.ok()) << document.error().message;
    io::ReadOptions reading;
    reading.blendAlpha = reading.colour = true;
    auto scene = io::readScene(*document, reading);
    ASSERT_TRUE(scene.ok()) << scene.error().message;
    const auto world = trace::World::build(*scene, {});
    const auto texture = trace::Opacity::make(trace::Method::texture, 4, *world, {}, {});
    const uint32_t width = full ? 480 : 96;
    const uint32_t height = full ? 270 : 54;
    const auto camera = trace::overview(*world, 16.0F / 9);
    const auto executor = makeThreadedExecutor(0);
    const auto maps = tests::mapsFor(*scene, trace::Method::sdag, 4, full ? 7 : 4);
    const auto groups = tests::mapsFor(*scene, trace::Method::bitmask, 4, 0);
    std::vector<jobs::OpacityInput> inputs;
    for (const trace::Method method : tests::methodsWithStates) {
        if (!full && isLong(GetParam(), method)) continue;
        auto input =
            jobs::readsSquares(method)
                ? tests::inputFor(*scene, *world, method, 4, 0)
                : jobs::makeOpacity(method, 4, *scene, method == trace::Method::bitmask ? groups : maps,
                                    *world, *executor);
        ASSERT_TRUE(input.ok()) << input.error().message;
        inputs.push_back(std::move(*input));
    }
    for (const trace::Integrator integrator : tests::integrators) {
        trace::RenderSettings settings = tests::settingsFor(integrator, width, height);
        settings.camera = camera;
        const trace::Film expected = tests::filmOf(*world, *texture, settings, 1, *executor);
        EXPECT_GT(expected.counters.total().candidateHits, 0u);
        for (const auto& input : inputs) {
            SCOPED_TRACE(fmt::format("{} {}", nameOf(input.opacity->method()), nameOf(integrator)));
            const trace::Film film = tests::filmOf(*world, *input.opacity, settings, 1, *executor);
            EXPECT_EQ(film.sums, expected.sums);
            EXPECT_LT(film.counters.total().textureFetches, expected.counters.total().textureFetches);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Files, SharedScenes,
                         testing::Values("0ad_forest_temperate.glb", "crytek_sponza.glb",
                                         "sh3d_nets_and_plants.glb", "stk_black_forest.glb"),
                         [](const auto& test) { return test.param.substr(0, test.param.find('.')); });

}  // namespace
}  // namespace filigree
