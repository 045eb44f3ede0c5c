#include "scenes.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace filigree::verify {
namespace {

using micromap::FlatSet;
using micromap::Format;
using micromap::Record;
using micromap::State;
using testing::HasSubstr;
using tests::maskTest;
using tests::Random;

// A flat set that the judge itself filled with the truths of each triangle; uncertain becomes unknown.
FlatSet trueSet(const std::vector<mesh::UvTriangle>& triangles, unsigned level, Format format,
                const Judge& judge) {
    FlatSet set;
    for (const mesh::UvTriangle& triangle : triangles) {
        const auto offset = static_cast<uint32_t>(set.data.size());
        set.indices.push_back(static_cast<int32_t>(set.records.size()));
        set.records.push_back({offset, static_cast<uint16_t>(level), format});
        set.data.resize(offset + micromap::flatBytes(level, format));
        const unsigned bits = micromap::bitsPerState(format);
        for (uint32_t m = 0; m < micromap::microTriangleCount(level); ++m) {
            const Truth truth = judge.truth(triangle, level, m);
            const unsigned state = truth == Truth::transparent ? 0 : truth == Truth::opaque ? 1 : 2;
            set.data[offset + m * bits / 8] |=
                static_cast<uint8_t>((state & ((1U << bits) - 1)) << (m * bits % 8));
        }
    }
    return set;
}

struct Scene {
    image::AlphaTexture texture;
    std::vector<mesh::UvTriangle> triangles;
};

Scene randomScene(uint32_t seed, unsigned count) {
    Random random(seed);
    Scene scene;
    scene.texture =
        tests::texture8(16, 16, [&](uint32_t, uint32_t) { return random.below(4) == 0 ? 0U : 255U; });
    for (unsigned t = 0; t < count; ++t) scene.triangles.push_back(random.triangle(1));
    return scene;
}

DeepCounts checked(const Scene& scene, const FlatSet& set, const DeepSettings& settings = {},
                   const Executor& executor = serialExecutor()) {
    auto counts =
        deepCheck(scene.triangles, set, scene.texture, maskTest(), settings, executor, silentProgress());
    EXPECT_TRUE(counts.ok()) << (counts.ok() ? "" : counts.error().message);
    return counts.ok() ? *counts : DeepCounts{};
}

std::string errorOf(const Scene& scene, const FlatSet& set, const image::AlphaTest& test = maskTest(),
                    const DeepSettings& settings = {}) {
    auto counts =
        deepCheck(scene.triangles, set, scene.texture, test, settings, serialExecutor(), silentProgress());
    return counts.ok() ? "" : counts.error().message;
}

TEST(DeepCheck, PassesWhatIsTrue) {
    const Scene scene = randomScene(1, 20);
    const Judge judge(scene.texture, maskTest());
    for (const Format format : {Format::fourState, Format::twoState}) {
        const DeepCounts counts = checked(scene, trueSet(scene.triangles, 4, format, judge));
        EXPECT_EQ(counts.microTriangles, 20 * 256U);
        EXPECT_EQ(counts.wrong, 0U);
        EXPECT_EQ(counts.overCautious, 0U);
        EXPECT_EQ(counts.uncertain, 0U);
        EXPECT_TRUE(counts.first.empty());
    }
}

TEST(DeepCheck, FindsEachFlippedState) {
    const Scene scene = randomScene(2, 5);
    const Judge judge(scene.texture, maskTest());
    const FlatSet right = trueSet(scene.triangles, 3, Format::fourState, judge);
    for (uint32_t m = 0; m < 64; ++m) {
        for (unsigned change = 1; change < 4; ++change) {
            FlatSet set = right;
            uint8_t& byte = set.data[set.records[3].byteOffset + m / 4];
            const unsigned shift = 2 * (m % 4);
            const unsigned before = byte >> shift & 3U;
            const unsigned after = before ^ change;
            byte = static_cast<uint8_t>(byte ^ change << shift);
            const DeepCounts counts = checked(scene, set);
            EXPECT_EQ(counts.wrong, after < 2 ? 1U : 0U);
            EXPECT_EQ(counts.overCautious, after >= 2 && before < 2 ? 1U : 0U);
            if (after >= 2) continue;
            ASSERT_EQ(counts.first.size(), 1U);
            EXPECT_EQ(counts.first[0].triangle, 3U);
            EXPECT_EQ(counts.first[0].microTriangle, m);
            EXPECT_EQ(counts.first[0].level, 3U);
            EXPECT_EQ(counts.first[0].state, static_cast<State>(after));
            EXPECT_EQ(counts.first[0].truth, judge.truth(scene.triangles[3], 3, m));
        }
    }
}

TEST(DeepCheck, TwoStatesAreWrongOnlyOnTheOtherSide) {
    const Scene scene = randomScene(3, 5);
    const Judge judge(scene.texture, maskTest());
    const FlatSet right = trueSet(scene.triangles, 3, Format::twoState, judge);
    for (uint32_t m = 0; m < 64; ++m) {
        FlatSet set = right;
        set.data[m / 8] = static_cast<uint8_t>(set.data[m / 8] ^ 1U << (m % 8));
        const bool known = judge.truth(scene.triangles[0], 3, m) != Truth::mixed;
        EXPECT_EQ(checked(scene, set).wrong, known ? 1U : 0U);
    }
}

TEST(DeepCheck, SpecialIndicesAreJudgedAsWholes) {
    Scene scene;
    scene.texture = tests::texture8(8, 1, [](uint32_t x, uint32_t) { return x < 4 ? 255 : 0; });
    const auto at = [&](float from, float to) {
        return tests::triangleInTexels(scene.texture, {from, 0}, {to, 0}, {from, 1});
    };
    scene.triangles = {at(1, 3), at(5, 7), at(3, 5)};
    const auto counts = [&](State state, Format format = Format::fourState) {
        FlatSet set;
        set.indices.assign(3, micromap::specialIndex(state));
        DeepSettings settings;
        settings.specialFormat = format;
        return checked(scene, set, settings);
    };
    EXPECT_EQ(counts(State::opaque).wrong, 2U);
    EXPECT_EQ(counts(State::transparent).wrong, 2U);
    EXPECT_EQ(counts(State::unknownOpaque).wrong, 0U);
    EXPECT_EQ(counts(State::unknownOpaque).overCautious, 2U);
    EXPECT_EQ(counts(State::opaque, Format::twoState).wrong, 1U);
    EXPECT_EQ(counts(State::opaque).microTriangles, 3U);
}

TEST(DeepCheck, TrianglesWithoutNumbersMustBeUnknown) {
    Scene scene;
    scene.texture = tests::texture8(2, 2, [](uint32_t, uint32_t) { return 255; });
    scene.triangles = {tests::triangleOf({std::numeric_limits<float>::quiet_NaN(), 0}, {1, 0}, {0, 1})};
    FlatSet set;
    set.indices = {micromap::specialIndex(State::unknownOpaque)};
    EXPECT_EQ(checked(scene, set).wrong, 0U);
    EXPECT_EQ(checked(scene, set).overCautious, 0U);
    set.indices = {micromap::specialIndex(State::opaque)};
    EXPECT_EQ(checked(scene, set).wrong, 1U);
}

TEST(DeepCheck, CountsTheUncertainAlone) {
    Scene scene;
    scene.texture = tests::texture8(1, 1, [](uint32_t, uint32_t) { return 51; });
    scene.triangles = {tests::triangleOf({0, 0}, {1, 0}, {0, 1})};
    FlatSet set;
    for (const State state : {State::opaque, State::transparent, State::unknownOpaque}) {
        set.indices = {micromap::specialIndex(state)};
        auto counts = deepCheck(scene.triangles, set, scene.texture, maskTest(0.2), {}, serialExecutor(),
                                silentProgress());
        ASSERT_TRUE(counts.ok());
        EXPECT_EQ(counts->uncertain, 1U);
        EXPECT_EQ(counts->wrong + counts->overCautious, 0U);
    }
}

TEST(DeepCheck, IsTheSameOnAnyNumberOfThreads) {
    const Scene scene = randomScene(4, 300);
    FlatSet set = trueSet(scene.triangles, 3, Format::fourState, Judge(scene.texture, maskTest()));
    for (size_t b = 1000; b < set.data.size(); b += 7) set.data[b] ^= 0x55;
    const DeepCounts one = checked(scene, set);
    EXPECT_EQ(one.first.size(), 16U);
    EXPECT_GT(one.wrong, 16U);
    const auto threads = makeThreadedExecutor(4);
    for (int round = 0; round < 5; ++round) {
        const DeepCounts many = checked(scene, set, {}, *threads);
        EXPECT_EQ(many.microTriangles, one.microTriangles);
        EXPECT_EQ(many.wrong, one.wrong);
        EXPECT_EQ(many.overCautious, one.overCautious);
        ASSERT_EQ(many.first.size(), one.first.size());
        for (size_t f = 0; f < one.first.size(); ++f) {
            EXPECT_EQ(many.first[f].triangle, one.first[f].triangle);
            EXPECT_EQ(many.first[f].microTriangle, one.first[f].microTriangle);
        }
    }
}

TEST(DeepCheck, SamplesTheShareThatIsAskedFor) {
    const Scene scene = randomScene(5, 100);
    const FlatSet set = trueSet(scene.triangles, 4, Format::fourState, Judge(scene.texture, maskTest()));
    DeepSettings settings;
    settings.sample = 0.25;
    const uint64_t count = checked(scene, set, settings).microTriangles;
    EXPECT_NEAR(static_cast<double>(count), 6400, 250);
    EXPECT_EQ(checked(scene, set, settings).microTriangles, count);
    settings.seed = 2;
    EXPECT_NE(checked(scene, set, settings).microTriangles, count);
    settings.sample = 0;
    EXPECT_EQ(checked(scene, set, settings).microTriangles, 0U);
}

TEST(DeepCheck, RefusesWhatPointsOutside) {
    const Scene scene = randomScene(6, 2);
    const FlatSet right = trueSet(scene.triangles, 2, Format::fourState, Judge(scene.texture, maskTest()));
    EXPECT_EQ(errorOf(scene, right), "");
    FlatSet set = right;
    set.indices = {0};
    EXPECT_EQ(errorOf(scene, set), "1 micromap indices for 2 triangles");
    set = right;
    set.indices[1] = 2;
    EXPECT_EQ(errorOf(scene, set), "triangle 1: micromap index 2, expected -4 to 1");
    set.indices[1] = -5;
    EXPECT_THAT(errorOf(scene, set), HasSubstr("micromap index -5"));
    set = right;
    set.records[1].byteOffset = 5;
    EXPECT_EQ(errorOf(scene, set), "micromap record 1: ends at byte 9 of 8");
    set.records[1] = {0, 13, Format::fourState};
    EXPECT_THAT(errorOf(scene, set), HasSubstr("level 13"));
    set.records[1] = {0, 1, static_cast<Format>(3)};
    EXPECT_THAT(errorOf(scene, set), HasSubstr("format 3"));
}

TEST(DeepCheck, RefusesSettingsOutOfRange) {
    Scene scene = randomScene(7, 1);
    FlatSet set;
    set.indices = {-1};
    image::AlphaTest test = maskTest(std::numeric_limits<double>::quiet_NaN());
    EXPECT_THAT(errorOf(scene, set, test), HasSubstr("cutoff"));
    test = maskTest(0.5, -1);
    EXPECT_THAT(errorOf(scene, set, test), HasSubstr("guard"));
    DeepSettings settings;
    settings.sample = 1.5;
    EXPECT_THAT(errorOf(scene, set, maskTest(), settings), HasSubstr("sample"));
    scene.texture.image.texels.pop_back();
    EXPECT_THAT(errorOf(scene, set), HasSubstr("alpha image"));
}

class Stopped final : public ProgressSink {
  public:
    void begin(std::string_view, uint64_t, std::string_view) override {}
    void advance(uint64_t) override {}
    void end() override {}
    [[nodiscard]] bool cancelled() const override { return true; }
};

TEST(DeepCheck, StopsWhenCancelled) {
    const Scene scene = randomScene(8, 10);
    FlatSet set;
    set.indices.assign(10, -4);
    Stopped stopped;
    auto counts = deepCheck(scene.triangles, set, scene.texture, maskTest(), {}, serialExecutor(), stopped);
    ASSERT_FALSE(counts.ok());
    EXPECT_EQ(counts.error().kind, ErrorKind::cancelled);
}

}  // namespace
}  // namespace filigree::verify
