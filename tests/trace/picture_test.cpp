// Maps change what a picture costs and nothing else; neither do threads.
#include "jobs/psnr.h"
#include "trace/thicket.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <functional>
#include <thread>
#include <vector>

#include <fmt/format.h>

namespace filigree {
namespace {

using trace::Integrator;
using trace::Method;

class Pictures : public testing::Test {
  protected:
    static constexpr uint32_t width = 72;
    static constexpr uint32_t height = 48;
    static constexpr unsigned samples = 2;

    Pictures() : scene_(tests::thicket()), world_(std::move(*trace::World::build(scene_, {}))) {}

    [[nodiscard]] trace::RenderSettings settings(Integrator integrator) const {
        trace::RenderSettings s = tests::settingsFor(integrator, width, height);
        s.camera = trace::lookAt({0.4F, 0.5F, 3.4F}, {0.1F, -0.1F, 0}, {0, 1, 0}, 0.9F);
        return s;
    }
    trace::Film reference(const trace::RenderSettings& s) const {
        const auto texture = trace::Opacity::make(Method::texture, 4, world_, {}, {});
        return tests::filmOf(world_, *texture, s, samples);
    }

    scene::Scene scene_;
    trace::World world_;
};

// Counters that hold for every method with four states.
void expectPlausible(const trace::Film& film, const trace::Film& reference) {
    for (size_t k = 0; k < trace::rayKindCount; ++k) {
        const auto kind = static_cast<trace::RayKind>(k);
        const trace::RayCounts& counts = film.counters[kind];
        EXPECT_EQ(counts.rays, reference.counters[kind].rays);
        EXPECT_EQ(counts.candidateHits, reference.counters[kind].candidateHits);
        EXPECT_EQ(counts.textureFetches, counts.unknown);
        EXPECT_LE(counts.lookups, counts.candidateHits);
    }
    EXPECT_LT(film.counters.total().textureFetches, reference.counters.total().textureFetches);
    uint64_t tests = 0;
    for (const uint32_t count : film.alphaTests) tests += count;
    EXPECT_EQ(tests, film.counters.total().textureFetches);
}

TEST_F(Pictures, AreTheSameToTheBitWithEveryMethodOfFourStates) {
    for (const Method method : tests::methodsWithStates) {
        const auto input = tests::inputFor(scene_, world_, method, 4, 5);
        ASSERT_TRUE(input.ok()) << input.error().message;
        for (const Integrator integrator : tests::integrators) {
            SCOPED_TRACE(fmt::format("{} {}", nameOf(method), nameOf(integrator)));
            const trace::Film expected = reference(settings(integrator));
            const trace::Film film = tests::filmOf(world_, *input->opacity, settings(integrator), samples);
            EXPECT_EQ(film.sums, expected.sums);
            EXPECT_EQ(film.pixelsHit, expected.pixelsHit);
            expectPlausible(film, expected);
        }
    }
}

TEST_F(Pictures, DeferringTestsChangesNoPixelAndSavesSome) {
    const auto maps = tests::mapsFor(scene_, Method::sdag, 4, 3);
    const auto input = jobs::makeOpacity(Method::sdag, 4, scene_, maps, world_, serialExecutor());
    for (const Integrator integrator : {Integrator::shadow, Integrator::ao, Integrator::path}) {
        SCOPED_TRACE(nameOf(integrator));
        trace::RenderSettings s = settings(integrator);
        const trace::Film without = tests::filmOf(world_, *input->opacity, s, samples);
        s.defer = true;
        const trace::Film with = tests::filmOf(world_, *input->opacity, s, samples);
        EXPECT_EQ(with.sums, without.sums);
        EXPECT_LE(with.counters.total().textureFetches, without.counters.total().textureFetches);
    }
}

TEST_F(Pictures, TwoStatesFetchNothingAndComeClose) {
    for (const Method method : tests::methodsWithStates) {
        const auto input = tests::inputFor(scene_, world_, method, 2, 6);
        ASSERT_TRUE(input.ok()) << input.error().message;
        const trace::RenderSettings s = settings(Integrator::ao);
        const trace::Film film = tests::filmOf(world_, *input->opacity, s, samples);
        const double decibels = jobs::psnr(developed(film), developed(reference(s)));
        fmt::print("{}, 2 states: PSNR {:.2f} dB\n", nameOf(method), decibels);
        // The bitmask does not know vertex alpha, and its cells are as large as texels.
        if (method != Method::bitmask) {
            EXPECT_EQ(film.counters.total().textureFetches, 0u);
        }
        EXPECT_GT(decibels, 12);
    }
}

TEST_F(Pictures, FourStateMapsServeShadowRaysAsTwoState) {
    const auto maps = tests::mapsFor(scene_, Method::micromap, 4, 5);
    const auto input = jobs::makeOpacity(Method::micromap, 4, scene_, maps, world_, serialExecutor());
    trace::RenderSettings s = settings(Integrator::shadow);
    s.twoStateShadows = true;
    const trace::Film film = tests::filmOf(world_, *input->opacity, s, samples);
    EXPECT_EQ(film.counters[trace::RayKind::shadow].textureFetches, 0u);
    EXPECT_GT(film.counters[trace::RayKind::primary].textureFetches, 0u);
}

// As many threads as it says, however few processors there are, from the last range to the first.
class Crowd final : public Executor {
  public:
    explicit Crowd(unsigned threads) : threads_(threads) {}

    void parallelFor(size_t count, size_t grain,
                     const std::function<void(size_t, size_t)>& body) const override {
        const size_t step = std::max<size_t>(grain, 1);
        std::atomic<size_t> left{(count + step - 1) / step};
        const auto work = [&] {
            for (size_t range = left--; range > 0 && range <= count; range = left--) {
                body((range - 1) * step, std::min(count, range * step));
                std::this_thread::yield();
            }
        };
        std::vector<std::jthread> crowd;
        for (unsigned k = 0; k < threads_; ++k) crowd.emplace_back(work);
    }
    [[nodiscard]] unsigned concurrency() const override { return threads_; }

  private:
    unsigned threads_;
};

TEST_F(Pictures, DoNotDependOnThreads) {
    const auto maps = tests::mapsFor(scene_, Method::sdag, 4, 4);
    const auto input = jobs::makeOpacity(Method::sdag, 4, scene_, maps, world_, serialExecutor());
    for (const Integrator integrator : tests::integrators) {
        const trace::Film one = tests::filmOf(world_, *input->opacity, settings(integrator), samples);
        for (const unsigned threads : {2u, 5u}) {
            SCOPED_TRACE(fmt::format("{} {}", nameOf(integrator), threads));
            const trace::Film many =
                tests::filmOf(world_, *input->opacity, settings(integrator), samples, Crowd(threads));
            EXPECT_EQ(many.sums, one.sums);
            EXPECT_EQ(many.alphaTests, one.alphaTests);
            EXPECT_EQ(many.counters.total().lookups, one.counters.total().lookups);
        }
    }
}

TEST_F(Pictures, ASeedMakesAnother) {
    trace::RenderSettings s = settings(Integrator::ao);
    const trace::Film first = reference(s);
    s.seed = 2;
    EXPECT_NE(reference(s).sums, first.sums);
}

TEST_F(Pictures, BlendLetsItsShareOfRaysThrough) {
    scene::Scene scene;
    scene.images.push_back({"grey", image::alphaImageFrom8Bit(1, 1, std::array<uint8_t, 1>{64}), {}});
    scene::Material& material = scene.materials.emplace_back();
    material.image = 0;
    material.alphaMode = scene::AlphaMode::blend;
    scene.meshes.push_back({"", {tests::card(0, 0, 0, 1)}});
    scene.instances.emplace_back();
    const auto world = trace::World::build(scene, {});
    trace::RenderSettings s = tests::settingsFor(Integrator::primary, 64, 64);
    s.camera = trace::lookAt({0, 0, 1}, {0, 0, 0}, {0, 1, 0}, 0.5F);
    const auto texture = trace::Opacity::make(Method::texture, 4, *world, {}, {});
    const trace::Film film = tests::filmOf(*world, *texture, s, 8);
    EXPECT_NEAR(static_cast<double>(film.pixelsHit) / (64 * 64 * 8), 64.0 / 255, 0.01);
}

TEST(Film, IsExposedWithItsColours) {
    trace::Film film(2, 1);
    film.samples = 2;
    film.sums = {{2, 1, 0}, {9, 9, 9}};
    EXPECT_EQ(trace::exposed(film, 0.5F).rgba, (std::vector<uint8_t>{188, 137, 0, 255, 255, 255, 255, 255}));
    const Vec3 linear = trace::albedoOfSrgb({188, 137, 0});
    EXPECT_NEAR(linear[0], 0.5, 0.005);
    EXPECT_NEAR(linear[1], 0.25, 0.005);
    EXPECT_EQ(linear[2], 0);
}

}  // namespace
}  // namespace filigree
