// Pictures by a device: the same with every method of four states, and those of the CPU but for edges.
#include "filigree/scene/camera_rays.h"
#include "filigree/trace/rays.h"

#include "jobs/device_picture.h"
#include "trace/thicket.h"
#include "vulkan/film_difference.h"
#include "vulkan/test_device.h"

#include <fmt/format.h>

namespace filigree {
namespace {

using trace::Integrator;
using trace::Method;

class VulkanPictures : public tests::VulkanTest {
  protected:
    static constexpr unsigned samples = 2;

    VulkanPictures() : scene_(tests::thicket()) {}

    void SetUp() override {
        VulkanTest::SetUp();
        if (IsSkipped() || HasFatalFailure()) return;
        if (!device_->facts().tracesRays()) GTEST_SKIP() << "no Vulkan device was found that traces rays";
        device_.reset();
        // Random numbers decide hits with BLEND, from the bits of weights that differ between CPU and device.
        for (auto& material : scene_.materials) {
            if (material.alphaMode == scene::AlphaMode::blend) material.alphaMode = scene::AlphaMode::mask;
        }
        world_.emplace(std::move(*trace::World::build(scene_, {})));
        auto opened = jobs::DeviceScene::open(options(), {}, scene_, *world_);
        ASSERT_TRUE(opened.ok()) << opened.error().message;
        onDevice_.emplace(std::move(*opened));
    }
    void TearDown() override {
        onDevice_.reset();
        VulkanTest::TearDown();
    }

    [[nodiscard]] trace::RenderSettings settings(Integrator integrator) const {
        trace::RenderSettings s = tests::settingsFor(integrator, 96, 64);
        s.camera = trace::lookAt({0.4F, 0.5F, 3.4F}, {0.1F, -0.1F, 0}, {0, 1, 0}, 0.9F);
        return s;
    }

    jobs::OpacityInput inputFor(Method method, unsigned states) {
        jobs::BakeParameters parameters;
        parameters.includeBlend = true;
        if (jobs::readsMaps(method)) bake(method, states);
        auto input = jobs::readsSquares(method)
                         ? jobs::makeSquareOpacity(method, states, scene_, parameters, *world_,
                                                   serialExecutor(), silentProgress())
                         : jobs::makeOpacity(method, states, scene_, maps_, *world_, serialExecutor());
        EXPECT_TRUE(input.ok()) << input.error().message;
        return std::move(*input);
    }

    // Once for all methods that read the same maps.
    void bake(Method method, unsigned states) {
        const std::pair wanted(method == Method::bitmask, states);
        if (baked_ == wanted) return;
        maps_ = tests::mapsFor(scene_, method, states, 5);
        baked_ = wanted;
    }

    vulkan::Painter painterFor(const jobs::OpacityInput& input) {
        auto painter = onDevice_->prepare(input, maps_);
        EXPECT_TRUE(painter.ok()) << painter.error().message;
        return std::move(*painter);
    }

    trace::Film film(vulkan::Painter& painter, const trace::RenderSettings& s) {
        auto made = onDevice_->render(painter, s, samples, silentProgress());
        EXPECT_TRUE(made.ok()) << made.error().message;
        return std::move(*made);
    }

    // Shadows on the device, which must fetch nothing, and on the CPU.
    std::pair<trace::Film, trace::Film> withTwoStates(Method method) {
        const auto input = inputFor(method, 2);
        auto painter = painterFor(input);
        const trace::RenderSettings s = settings(Integrator::shadow);
        trace::Film device = film(painter, s);
        EXPECT_EQ(device.counters.total().textureFetches, 0u);
        return {std::move(device), tests::filmOf(*world_, *input.opacity, s, samples)};
    }

    scene::Scene scene_;
    std::optional<trace::World> world_;
    jobs::SceneMaps maps_;
    std::optional<std::pair<bool, unsigned>> baked_;  // what `maps_` are: of a bitmask, and states
    std::optional<jobs::DeviceScene> onDevice_;
};

TEST_F(VulkanPictures, AreTheSameToTheBitWithEveryMethodOfFourStates) {
    auto texture = painterFor(inputFor(Method::texture, 4));
    std::vector<trace::Film> expected;
    for (const Integrator integrator : tests::integrators)
        expected.push_back(film(texture, settings(integrator)));
    for (const Method method : tests::methodsWithStates) {
        auto painter = painterFor(inputFor(method, 4));
        for (size_t k = 0; k < tests::integrators.size(); ++k) {
            SCOPED_TRACE(fmt::format("{} {}", nameOf(method), nameOf(tests::integrators[k])));
            const trace::Film found = film(painter, settings(tests::integrators[k]));
            EXPECT_EQ(found.sums, expected[k].sums);
            EXPECT_EQ(found.pixelsHit, expected[k].pixelsHit);
            const trace::RayCounts counts = found.counters.total();
            EXPECT_GT(counts.lookups, 0u);
            EXPECT_LT(counts.textureFetches, expected[k].counters.total().textureFetches);
        }
    }
}

// Says which pixels of a picture by the CPU lie at edges.
class EdgeFinder {
  public:
    EdgeFinder(const trace::World& world, const trace::Opacity& opacity,
               const trace::RenderSettings& settings, const trace::Film& film)
        : world_(world),
          opacity_(opacity),
          settings_(settings),
          film_(film),
          rays_(settings.camera, settings.width, settings.height) {}

    [[nodiscard]] bool isAtEdge(size_t pixel) const {
        const auto x = static_cast<uint32_t>(pixel % settings_.width);
        const auto y = static_cast<uint32_t>(pixel / settings_.width);
        return seesSeveral(x, y) || isUneven(x, y);
    }

  private:
    // Rays about the pixel meet more than one triangle, or a hole of a texture and what is behind.
    [[nodiscard]] bool seesSeveral(uint32_t x, uint32_t y) const {
        const uint64_t first = seenAt(static_cast<float>(x), static_cast<float>(y));
        constexpr int steps = 7;
        for (int k = 0; k < steps * steps; ++k) {
            const float across = static_cast<float>(k % steps) / (steps - 1) * 1.5F - 0.25F;
            const float down = static_cast<float>(k / steps) / (steps - 1) * 1.5F - 0.25F;
            if (seenAt(static_cast<float>(x) + across, static_cast<float>(y) + down) != first) return true;
        }
        return false;
    }
    [[nodiscard]] uint64_t seenAt(float x, float y) const {
        const trace::Ray ray{rays_.origin(), rays_.through(x, y), 1e30F, 0, trace::RayKind::primary};
        trace::Counters counters;
        return castRays(world_, opacity_, {&ray, 1}, false, counters).hash;
    }
    // Near-by pixels have other light: the colours of texels end, or some second rays are stopped and some
    // are not.
    [[nodiscard]] bool isUneven(uint32_t x, uint32_t y) const {
        Vec3 least{1e30F, 1e30F, 1e30F};
        Vec3 most{};
        for (uint32_t row = y - std::min(y, 1u); row <= std::min(y + 1, settings_.height - 1); ++row) {
            for (uint32_t column = x - std::min(x, 1u); column <= std::min(x + 1, settings_.width - 1);
                 ++column) {
                const Vec3& light = film_.sums[size_t{row} * settings_.width + column];
                for (size_t k = 0; k < 3; ++k) {
                    least[k] = std::min(least[k], light[k]);
                    most[k] = std::max(most[k], light[k]);
                }
            }
        }
        return most[0] > 1.02F * least[0] || most[1] > 1.02F * least[1] || most[2] > 1.02F * least[2];
    }

    const trace::World& world_;
    const trace::Opacity& opacity_;
    const trace::RenderSettings& settings_;
    const trace::Film& film_;
    scene::CameraRays rays_;
};

// One way of shaders, and all of another: what a ray finds depends on neither.
TEST_F(VulkanPictures, AreTheSameToTheBitWithQueriesAndPipelines) {
    const vulkan::DeviceFacts& facts = onDevice_->device().facts();
    if (!facts.rayQuery || !facts.rayPipeline) GTEST_SKIP() << "the device traces in one way only";
    const auto other = jobs::DeviceScene::open(options(), "pipeline", scene_, *world_);
    ASSERT_TRUE(other.ok()) << other.error().message;
    for (const Method method : {Method::texture, Method::sdag, Method::bitmask}) {
        const auto input = inputFor(method, 4);
        auto byQueries = painterFor(input);
        auto byPipeline = other->prepare(input, maps_);
        ASSERT_TRUE(byPipeline.ok()) << byPipeline.error().message;
        for (const Integrator integrator : tests::integrators) {
            SCOPED_TRACE(fmt::format("{} {}", nameOf(method), nameOf(integrator)));
            const trace::Film expected = film(byQueries, settings(integrator));
            const auto found = other->render(*byPipeline, settings(integrator), samples, silentProgress());
            ASSERT_TRUE(found.ok()) << found.error().message;
            EXPECT_EQ(found->sums, expected.sums);
            EXPECT_EQ(found->pixelsHit, expected.pixelsHit);
            EXPECT_EQ(found->counters.total().rays, expected.counters.total().rays);
        }
    }
}

TEST_F(VulkanPictures, AreThoseOfTheCpu) {
    for (const Method method : {Method::none, Method::texture, Method::sdag, Method::bitmask}) {
        const auto input = inputFor(method, 4);
        auto painter = painterFor(input);
        for (const Integrator integrator : tests::integrators) {
            SCOPED_TRACE(fmt::format("{} {}", nameOf(method), nameOf(integrator)));
            const trace::RenderSettings s = settings(integrator);
            const trace::Film cpu = tests::filmOf(*world_, *input.opacity, s, samples);
            const trace::Film device = film(painter, s);
            // The two round their arithmetic differently, so rays that graze the edge of a triangle, or of a
            // texel, may pass on either side: such pixels differ, a few, and no others.
            const auto pixels = tests::differingPixels(device, cpu);
            EXPECT_LE(pixels.size(), cpu.sums.size() / 1000);
            const EdgeFinder edges(*world_, *input.opacity, s, cpu);
            for (const size_t pixel : pixels) EXPECT_TRUE(edges.isAtEdge(pixel)) << "pixel " << pixel;
            for (size_t k = 0; k < trace::rayKindCount; ++k) {
                const auto kind = static_cast<trace::RayKind>(k);
                // Candidates depend on the order in which the device meets them.
                EXPECT_NEAR(static_cast<double>(device.counters[kind].rays),
                            static_cast<double>(cpu.counters[kind].rays), 4);
                EXPECT_LE(device.counters[kind].lookups, device.counters[kind].candidateHits);
            }
        }
    }
}

TEST_F(VulkanPictures, OfTwoStatesFetchNothing) {
    for (const Method method : {Method::micromap, Method::sdag}) {
        SCOPED_TRACE(nameOf(method));
        const auto [device, cpu] = withTwoStates(method);
        EXPECT_LE(tests::differing(device, cpu), cpu.sums.size() / 1000);
    }
}

// Chance is drawn from the bits of weights, which round otherwise on the CPU: hits are as frequent, not the
// same.
TEST_F(VulkanPictures, OfSquaresWithTwoStatesHitAsOftenAsOnTheCpu) {
    for (const Method method : {Method::vq2, Method::vq4Plus}) {
        SCOPED_TRACE(nameOf(method));
        const auto [device, cpu] = withTwoStates(method);
        const auto hits = static_cast<double>(cpu.pixelsHit);
        EXPECT_NEAR(static_cast<double>(device.pixelsHit), hits, hits / 100);
        EXPECT_GT(tests::differing(device, cpu), 0u) << "this scene has mixed regions in sight";
    }
}

TEST_F(VulkanPictures, ReadFourStatesAsTwoForShadows) {
    auto painter = painterFor(inputFor(Method::dag, 4));
    trace::RenderSettings s = settings(Integrator::shadow);
    s.twoStateShadows = true;
    const trace::Film found = film(painter, s);
    EXPECT_EQ(found.counters[trace::RayKind::shadow].textureFetches, 0u);
    EXPECT_GT(found.counters[trace::RayKind::primary].textureFetches, 0u);
}

TEST_F(VulkanPictures, SayWhatADeviceCannotDo) {
    auto painter = painterFor(inputFor(Method::texture, 4));
    trace::RenderSettings s = settings(Integrator::ao);
    s.defer = true;
    const auto deferred = onDevice_->render(painter, s, 1, silentProgress());
    ASSERT_FALSE(deferred.ok());
    EXPECT_EQ(deferred.error().kind, ErrorKind::unsupported);
}

TEST_F(VulkanPictures, OfHardwareMicromapsAreThoseOfTheTexture) {
    const auto input = inputFor(Method::micromap, 4);
    for (const auto build : {vulkan::StructureBuild::fastTrace, vulkan::StructureBuild::fastBuild}) {
        auto painter = onDevice_->prepare(input, maps_, {{}, build});
        if (!onDevice_->device().facts().micromaps) {
            ASSERT_FALSE(painter.ok());
            EXPECT_EQ(painter.error().kind, ErrorKind::unsupported);
            EXPECT_NE(painter.error().message.find("this device has no opacity micromaps"),
                      std::string::npos);
            continue;
        }
        ASSERT_TRUE(painter.ok()) << painter.error().message;
        auto texture = painterFor(inputFor(Method::texture, 4));
        for (const Integrator integrator : tests::integrators) {
            const trace::Film expected = film(texture, settings(integrator));
            const trace::Film found = film(*painter, settings(integrator));
            EXPECT_EQ(found.sums, expected.sums) << nameOf(integrator);
            EXPECT_LT(found.counters.total().textureFetches, expected.counters.total().textureFetches);
        }
    }
}

TEST_F(VulkanPictures, AreTimed) {
    auto painter = painterFor(inputFor(Method::texture, 4));
    const trace::RenderSettings s = settings(Integrator::ao);
    double seconds = 0;
    ASSERT_TRUE(onDevice_->render(painter, s, samples, silentProgress(), &seconds).ok());
    EXPECT_GT(seconds, 0);
    const auto frame = onDevice_->frameSeconds(painter, s, 1);
    ASSERT_TRUE(frame.ok()) << frame.error().message;
    EXPECT_GT(*frame, 0);
    EXPECT_LT(*frame, 60);
}

TEST_F(VulkanPictures, LeaveNothingBehind) {
    const auto input = inputFor(Method::micromap, 4);
    const uint64_t before = onDevice_->device().allocatedBytes();
    for (unsigned k = 0; k < 100;) {
        auto painter = painterFor(input);
        for (const uint64_t ready = onDevice_->device().allocatedBytes(); ++k % 25 != 0;) {
            (void)film(painter, tests::settingsFor(Integrator::primary, 8, 8));
            ASSERT_EQ(onDevice_->device().allocatedBytes(), ready);
        }
    }
    EXPECT_EQ(onDevice_->device().allocatedBytes(), before);
}

TEST_F(VulkanPictures, ShowTheSkyWhereThereIsNothing) {
    const scene::Scene nothing;
    const auto world = trace::World::build(nothing, {});
    const auto empty = jobs::DeviceScene::open(options(), {}, nothing, *world);
    ASSERT_TRUE(empty.ok()) << empty.error().message;
    jobs::OpacityInput input;
    input.opacity.emplace(std::move(*trace::Opacity::make(Method::texture, 4, *world, {}, {})));
    auto painter = empty->prepare(input, {});
    ASSERT_TRUE(painter.ok()) << painter.error().message;
    const auto film = empty->render(*painter, settings(Integrator::path), 1, silentProgress());
    ASSERT_TRUE(film.ok()) << film.error().message;
    EXPECT_EQ(film->pixelsHit, 0u);
    EXPECT_GT(film->sums.front()[2], 1.4F);
}

}  // namespace
}  // namespace filigree
