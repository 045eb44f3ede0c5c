// Levels, formats, sharing, rotation, executors, instruction sets and settings out of range.
#include "filigree/core/target.h"

#include "baking.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>

namespace filigree::bake::tests {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// A texture with an outline, and triangles of all sizes on it.
image::AlphaTexture blobs() {
    return texture8(96, 80, [](uint32_t x, uint32_t y) {
        return static_cast<unsigned>(127.5 + 127.5 * std::sin(x * 0.21) * std::cos(y * 0.17));
    });
}

std::vector<mesh::UvTriangle> manyTriangles(uint32_t seed, size_t count) {
    Random random(seed);
    std::vector<mesh::UvTriangle> triangles;
    for (size_t k = 0; k < count; ++k) triangles.push_back(random.triangle(k % 3 == 0 ? 1.5F : 0.2F));
    return triangles;
}

std::vector<uint8_t> bytesOf(const Baked& baked) {
    const auto flat = micromap::flatten(baked.set);
    EXPECT_TRUE(flat.ok());
    std::vector<uint8_t> bytes = flat->data;
    for (const int32_t index : flat->indices) bytes.push_back(static_cast<uint8_t>(index));
    for (const auto& record : flat->records) bytes.push_back(static_cast<uint8_t>(record.level));
    return bytes;
}

TEST(Levels, UsefulLevelIsTheLongestEdgesLogarithm) {
    const auto level = [](float texels, unsigned most = 12) {
        return usefulLevel(triangleOf({0, 0}, {texels / 64, 0}, {0, 0}), 64, 32, most);
    };
    EXPECT_EQ(level(0), 0U);
    EXPECT_EQ(level(0.5F), 0U);
    EXPECT_EQ(level(1), 0U);
    EXPECT_EQ(level(1.01F), 1U);
    EXPECT_EQ(level(2), 1U);
    EXPECT_EQ(level(64), 6U);
    EXPECT_EQ(level(65), 7U);
    EXPECT_EQ(level(1e6F), 12U);
    EXPECT_EQ(level(1e6F, 8), 8U);
    // Each axis counts its own texels: 48 and 20 make an edge of 52.
    EXPECT_EQ(usefulLevel(triangleOf({0, 0}, {0.75F, 0.625F}, {0, 0.1F}), 64, 32, 12), 6U);
    EXPECT_EQ(usefulLevel(triangleOf({0, 0}, {std::nanf(""), 0}, {0, 1}), 64, 32, 12), 0U);
    EXPECT_EQ(usefulLevel(triangleOf({-3e38F, 0}, {3e38F, 0}, {0, 1}), 64, 32, 12), 12U);
}

TEST(Levels, AutomaticFixedAndEachTriangleItsOwn) {
    const auto texture = blobs();
    const std::vector triangles{triangleInTexels(texture, {3, 3}, {5, 3}, {3, 5}),
                                triangleInTexels(texture, {3, 3}, {90, 3}, {3, 70}),
                                triangleInTexels(texture, {3, 3}, {3, 3}, {3, 3})};
    Settings settings;
    EXPECT_THAT(bakeAll(triangles, texture, maskTest(), settings).levels, ElementsAre(2, 7, 0));
    settings.maxLevel = 5;
    EXPECT_THAT(bakeAll(triangles, texture, maskTest(), settings).levels, ElementsAre(2, 5, 0));
    EXPECT_THAT(bakeAll(triangles, texture, maskTest(), atLevel(4)).levels, ElementsAre(4, 4, 4));
    const std::vector<uint8_t> levels{1, 0, 12};
    settings.levels = levels;
    const Baked baked = bakeAll(triangles, texture, maskTest(), settings);
    EXPECT_THAT(baked.levels, ElementsAre(1, 0, 12));
    EXPECT_EQ(baked.statistics.microTriangles, 4U + 1 + (1U << 24));
    EXPECT_EQ(baked.statistics.trianglesAt[12], 1U);
    EXPECT_EQ(baked.statistics.states.total(), baked.statistics.microTriangles);
}

TEST(Formats, TwoStateIsTheSideOfFourState) {
    const auto texture = blobs();
    const auto triangles = manyTriangles(1, 60);
    for (const double guard : {0.0, 0.25}) {
        Settings settings = atLevel(5);
        const Baked four = bakeAll(triangles, texture, maskTest(0.5, guard), settings);
        settings.format = micromap::Format::twoState;
        const Baked two = bakeAll(triangles, texture, maskTest(0.5, guard), settings);
        for (size_t t = 0; t < triangles.size(); ++t) {
            auto states = statesOf(four, t);
            for (State& state : states) state = micromap::knownOf(micromap::isOpaqueSide(state));
            ASSERT_EQ(statesOf(two, t), states) << t;
        }
        EXPECT_EQ(two.statistics.states.known(), two.statistics.microTriangles);
    }
}

TEST(Sharing, EqualMicromapsAreStoredOnce) {
    const auto texture = blobs();
    const auto a = triangleOf({0.1F, 0.1F}, {0.6F, 0.2F}, {0.3F, 0.7F});
    auto moved = a;  // other bits, the same texels
    for (mesh::Uv& p : moved.uv) p = {p.u * 0.5F + 0.25F, p.v * 0.5F + 0.25F};
    auto back = moved;
    for (mesh::Uv& p : back.uv) p.v += 4;
    const std::vector triangles{a, moved, a, back, moved};
    const Baked baked = bakeAll(triangles, texture, maskTest(), atLevel(4));
    EXPECT_EQ(baked.set.indices[0], 0);
    EXPECT_EQ(baked.set.indices[1], 1);
    EXPECT_EQ(baked.set.indices[2], 0);
    EXPECT_EQ(baked.set.indices[4], 1);
    EXPECT_EQ(baked.statistics.distinctTriangles, 3U);
    // Special states are told apart, and hold no micromap.
    const auto halves = texture8(8, 1, [](uint32_t x, uint32_t) { return x < 4 ? 255 : 0; });
    const std::vector special{triangleInTexels(halves, {1, 0}, {3, 0}, {1, 1}),
                              triangleInTexels(halves, {5, 0}, {7, 0}, {5, 1})};
    const Baked uniform = bakeAll(special, halves, maskTest(), atLevel(6));
    EXPECT_THAT(uniform.set.indices, ElementsAre(-2, -1));
    EXPECT_EQ(uniform.set.trees.size(), 0U);
}

TEST(Sharing, RotationsShareAndSayHowFarTheyTurned) {
    const auto texture = blobs();
    const auto base = triangleOf({0.1F, 0.1F}, {0.6F, 0.2F}, {0.3F, 0.7F});
    std::vector<mesh::UvTriangle> triangles{base, base, base};
    std::rotate(triangles[1].uv.begin(), triangles[1].uv.begin() + 1, triangles[1].uv.end());
    std::rotate(triangles[2].uv.begin(), triangles[2].uv.begin() + 2, triangles[2].uv.end());
    Settings settings = atLevel(4);
    EXPECT_TRUE(bakeAll(triangles, texture, maskTest(), settings).rotations.empty());
    settings.rotate = true;
    const Baked baked = bakeAll(triangles, texture, maskTest(), settings);
    EXPECT_THAT(baked.rotations, ElementsAre(0, 2, 1));
    EXPECT_EQ(baked.set.trees.size(), 1U);
}

// A micromap taken over by rotation is the one that the rotated triangle gets itself.
TEST(Sharing, RotatedMicromapsAreRight) {
    const auto texture = blobs();
    std::vector<mesh::UvTriangle> triangles = manyTriangles(5, 20);
    const size_t count = triangles.size();
    for (size_t k = 0; k < count; ++k) {
        triangles.push_back(triangles[k]);
        std::rotate(triangles.back().uv.begin(), triangles.back().uv.begin() + 1 + k % 2,
                    triangles.back().uv.end());
    }
    Settings settings = atLevel(5);
    settings.rotate = true;
    const Baked baked = bakeAll(triangles, texture, maskTest(), settings);
    size_t unlikeSides = 0;
    for (size_t t = 0; t < triangles.size(); ++t) {
        auto turned = triangles[t];
        std::rotate(turned.uv.begin(), turned.uv.begin() + baked.rotations[t], turned.uv.end());
        const auto expected = bakeOne(turned, texture, maskTest(), 5);
        const auto states = statesOf(baked, t);
        for (size_t k = 0; k < states.size(); ++k) {
            if (states[k] == expected[k]) continue;
            EXPECT_FALSE(micromap::isKnown(states[k]) || micromap::isKnown(expected[k])) << t << " " << k;
            ++unlikeSides;
        }
    }
    EXPECT_LT(unlikeSides, 10U);
    EXPECT_LE(baked.set.trees.size(), count);
}

TEST(Coarser, FinerStatesMakeTheCoarserOnes) {
    const auto texture = blobs();
    for (const auto& triangle : manyTriangles(9, 12)) {
        const Baked fine = bakeAll({&triangle, 1}, texture, maskTest(), atLevel(6));
        if (micromap::isSpecialIndex(fine.set.indices[0])) continue;
        for (const unsigned level : {5U, 3U, 0U}) {
            const auto direct = bakeOne(triangle, texture, maskTest(), level);
            const auto coarse = micromap::coarsened(fine.set.trees[0], level);
            std::vector<State> merged(direct.size());
            micromap::forEachLeaf(coarse.view(), [&](uint64_t first, unsigned depth, State state) {
                std::fill_n(merged.begin() + static_cast<std::ptrdiff_t>(first),
                            micromap::microTriangleCount(level - depth), state);
            });
            for (size_t k = 0; k < direct.size(); ++k) {
                EXPECT_EQ(micromap::isKnown(direct[k]), micromap::isKnown(merged[k])) << level << " " << k;
                if (micromap::isKnown(direct[k])) {
                    EXPECT_EQ(direct[k], merged[k]) << level << " " << k;
                }
            }
        }
    }
}

TEST(Determinism, SerialAndThreadedGiveTheSameBytes) {
    const auto texture = blobs();
    auto triangles = manyTriangles(3, 200);
    for (size_t k = 0; k < triangles.size(); k += 7) triangles[k].alpha = {1, 0.5F, 0.75F};
    const auto large = triangleOf({0, 0}, {1, 0}, {0, 1});
    const auto four = makeThreadedExecutor(4);
    Settings settings = atLevel(5);
    settings.rotate = true;
    EXPECT_EQ(bytesOf(bakeAll(triangles, texture, maskTest(), settings)),
              bytesOf(bakeAll(triangles, texture, maskTest(), settings, *four)));
    EXPECT_EQ(bytesOf(bakeAll({&large, 1}, texture, maskTest(), atLevel(11))),
              bytesOf(bakeAll({&large, 1}, texture, maskTest(), atLevel(11), *four)));
}

TEST(Determinism, AllInstructionSetsGiveTheSameBytes) {
    const std::string before = currentTarget();
    auto triangles = manyTriangles(4, 150);
    for (size_t k = 0; k < triangles.size(); k += 7) triangles[k].alpha.fill(0.7F);
    auto texture = blobs();
    texture.filter = image::Filter::both;
    std::vector<std::vector<uint8_t>> results;
    for (const char* target : {"scalar", "sse4", "avx2", "avx3", "best"}) {
        if (!forceTarget(target)) continue;
        for (const image::Wrap wrap :
             {image::Wrap::repeat, image::Wrap::mirroredRepeat, image::Wrap::clampToEdge}) {
            texture.wrapU = wrap;
            results.push_back(bytesOf(bakeAll(triangles, texture, maskTest(0.5, 1.0 / 256), atLevel(5))));
        }
    }
    ASSERT_TRUE(forceTarget("best").ok() && forceTargetFromEnvironment().ok());
    EXPECT_EQ(currentTarget(), before);
    ASSERT_GE(results.size(), 6U);
    for (size_t k = 3; k < results.size(); ++k) EXPECT_EQ(results[k], results[k % 3]) << k;
}

TEST(Errors, SettingsOutOfRangeAreUsageErrors) {
    const auto texture = blobs();
    const auto triangle = triangleOf({0, 0}, {1, 0}, {0, 1});
    const auto message = [&](const Settings& settings, const image::AlphaTest& test) {
        const auto baked = bake({&triangle, 1}, texture, test, settings, serialExecutor(), silentProgress());
        if (baked.ok()) return std::string("none");
        EXPECT_EQ(baked.error().kind, ErrorKind::usage);
        return baked.error().message;
    };
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    Settings settings;
    EXPECT_EQ(message(settings, maskTest()), "none");
    EXPECT_THAT(message(atLevel(13), maskTest()), HasSubstr("level 13"));
    settings.maxLevel = 13;
    EXPECT_THAT(message(settings, maskTest()), HasSubstr("13"));
    settings = {};
    for (const double bad : {-0.1, nan}) {
        EXPECT_THAT(message(settings, maskTest(bad)), HasSubstr("cutoff"));
        EXPECT_THAT(message(settings, maskTest(0.5, bad)), HasSubstr("guard"));
        auto test = maskTest();
        test.factor = bad;
        EXPECT_THAT(message(settings, test), HasSubstr("factor"));
    }
    EXPECT_THAT(message(settings, maskTest(0.5, 1025)), HasSubstr("guard"));
    auto test = maskTest();
    test.factor = 1.5;
    EXPECT_THAT(message(settings, test), HasSubstr("factor"));
    const std::vector<uint8_t> two{1, 2};
    settings.levels = two;
    EXPECT_THAT(message(settings, maskTest()), HasSubstr("2 levels for 1 triangles"));
    const std::vector<uint8_t> high{13};
    settings.levels = high;
    EXPECT_THAT(message(settings, maskTest()), HasSubstr("level 13"));
}

// Stops after the first report.
class Impatient final : public ProgressSink {
  public:
    void begin(std::string_view, uint64_t total, std::string_view) override { total_ = total; }
    void advance(uint64_t units) override { done_ += units; }
    void end() override {}
    [[nodiscard]] bool cancelled() const override { return done_ > 0; }

    uint64_t total_ = 0;
    std::atomic<uint64_t> done_ = 0;
};

TEST(Errors, CancellingStops) {
    const auto texture = blobs();
    const auto triangles = manyTriangles(6, 5000);
    Impatient impatient;
    const auto baked = bake(triangles, texture, maskTest(), atLevel(3), serialExecutor(), impatient);
    ASSERT_FALSE(baked.ok());
    EXPECT_EQ(baked.error().kind, ErrorKind::cancelled);
    EXPECT_EQ(impatient.total_, 5000U);
    EXPECT_LT(impatient.done_, 1000U);
}

TEST(Edges, NoTrianglesAtAll) {
    const Baked baked = bakeAll({}, blobs(), maskTest(), Settings{});
    EXPECT_TRUE(baked.set.indices.empty());
    EXPECT_EQ(baked.statistics.microTriangles, 0U);
}

TEST(Edges, ManyVertexAlphasAreStillRight) {
    // More constant vertex alphas than are traced each on its own.
    const auto texture = blobs();
    auto triangles = manyTriangles(8, 40);
    for (size_t k = 0; k < triangles.size(); ++k)
        triangles[k].alpha.fill(0.5F + 0.01F * static_cast<float>(k));
    const auto counts =
        judged(bakeAll(triangles, texture, maskTest(), atLevel(4)), triangles, texture, maskTest());
    EXPECT_EQ(counts.wrong, 0U);
    EXPECT_LE(counts.overCautious * 1000, counts.microTriangles * 3);
}

}  // namespace
}  // namespace filigree::bake::tests
