#include "filigree/image/alpha_image.h"

#include "textures.h"

#include <cmath>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace filigree::image {
namespace {

using testing::ElementsAre;
using tests::Random;

AlphaImage imageOf(uint32_t width, uint32_t height, std::vector<uint16_t> texels) {
    return {width, height, std::move(texels), 65535};
}

TEST(AlphaImage, ReadsAnyPixels) {
    const std::vector<uint8_t> bytes{9, 9, 9, 0,   9, 9, 9, 1,  7, 7,  //
                                     9, 9, 9, 128, 9, 9, 9, 255};
    const auto rgba = alphaImageFrom({.bytes = bytes, .width = 2, .height = 2, .rowBytes = 10});
    ASSERT_TRUE(rgba) << rgba.error().message;
    EXPECT_THAT(rgba->texels, ElementsAre(0, 257, 128 * 257, 65535));
    EXPECT_EQ(rgba->steps, 255U);

    const std::vector<uint8_t> wide{0, 0x34, 0x12, 0, 0x78, 0x56};
    const auto deep =
        alphaImageFrom({.bytes = wide, .width = 2, .height = 1, .pixelBytes = 3, .alphaAt = 1, .bits = 16});
    ASSERT_TRUE(deep) << deep.error().message;
    EXPECT_THAT(deep->texels, ElementsAre(0x1234, 0x5678));
    EXPECT_EQ(deep->steps, 65535U);
}

TEST(AlphaImage, RefusesPixelsThatAreNotThere) {
    const std::vector<uint8_t> bytes(16);
    for (const PixelView& view :
         {PixelView{bytes, 2, 3}, PixelView{bytes, 0, 1}, PixelView{bytes, 1, 65537},
          PixelView{bytes, 65536, 65536}, PixelView{bytes, 4, 1, 4, 4}, PixelView{bytes, 4, 1, 4, 3, 16},
          PixelView{bytes, 4, 1, 0, 0}, PixelView{bytes, 4, 1, 4, 3, 7}, PixelView{bytes, 2, 2, 4, 3, 8, 7},
          PixelView{bytes, 2, 2, 4, 3, 8, SIZE_MAX}, PixelView{bytes, 1, 2, 4, 3, 8, 13},
          PixelView{{}, 1, 1}}) {
        const auto image = alphaImageFrom(view);
        ASSERT_FALSE(image);
        EXPECT_EQ(image.error().kind, ErrorKind::usage) << image.error().message;
    }
    EXPECT_TRUE(alphaImageFrom({bytes, 1, 2, 4, 3, 8, 12}));
}

TEST(AlphaImage, ChecksWhatItPromises) {
    EXPECT_TRUE(check(imageOf(2, 1, {1, 2})));
    EXPECT_FALSE(check(imageOf(2, 2, {1, 2})));
    EXPECT_FALSE(check(AlphaImage{}));
    AlphaImage odd = imageOf(1, 1, {1});
    odd.steps = 100;
    EXPECT_FALSE(check(odd));
}

TEST(AlphaImage, EightBitIsExact) {
    const std::vector<uint8_t> bytes{0, 1, 128, 255};
    const AlphaImage image = alphaImageFrom8Bit(2, 2, bytes);
    EXPECT_THAT(image.texels, ElementsAre(0, 257, 128 * 257, 65535));
    EXPECT_EQ(image.steps, 255U);
    EXPECT_EQ(image.at(0, 1), 128 * 257);
    for (unsigned a = 0; a < 256; ++a) EXPECT_EQ(a * 257 / 65535.0, a / 255.0);
}

TEST(Wrap, ReadsAsTheStandardsSay) {
    const auto row = [](Wrap wrap, uint32_t size) {
        std::vector<uint32_t> texels;
        for (int64_t x = -5; x < 8; ++x) texels.push_back(wrapTexel(x, size, wrap));
        return texels;
    };
    EXPECT_THAT(row(Wrap::repeat, 3), ElementsAre(1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1));
    EXPECT_THAT(row(Wrap::mirroredRepeat, 3), ElementsAre(1, 2, 2, 1, 0, 0, 1, 2, 2, 1, 0, 0, 1));
    EXPECT_THAT(row(Wrap::clampToEdge, 3), ElementsAre(0, 0, 0, 0, 0, 0, 1, 2, 2, 2, 2, 2, 2));
    for (const Wrap wrap : tests::wraps) {
        for (int64_t x = -9; x < 9; ++x) EXPECT_EQ(wrapTexel(x, 1, wrap), 0U);
        for (const int64_t x : {int64_t{1} << 40, -(int64_t{1} << 40)}) EXPECT_LT(wrapTexel(x, 7, wrap), 7U);
    }
}

TEST(Sampling, TexelCentresReadTexels) {
    Random random(1);
    for (int round = 0; round < 30; ++round) {
        const AlphaTexture t = random.texture(1 + random.below(6), 1 + random.below(6));
        for (int64_t y = -8; y < 14; ++y) {
            for (int64_t x = -8; x < 14; ++x) {
                const double alpha =
                    t.image.at(wrapTexel(x, t.image.width, t.wrapU), wrapTexel(y, t.image.height, t.wrapV)) /
                    65535.0;
                const auto cx = static_cast<double>(x) + 0.5;
                const auto cy = static_cast<double>(y) + 0.5;
                EXPECT_EQ(sampleBilinear(t, cx, cy), alpha);
                EXPECT_EQ(sampleNearest(t, cx, cy), alpha);
                EXPECT_EQ(sampleNearest(t, cx - 0.5, cy - 0.5), alpha) << "squares hold their lower sides";
                EXPECT_EQ(sampleNearest(t, cx + 0.499, cy + 0.499), alpha);
            }
        }
    }
}

TEST(Sampling, BilinearMixesFourNeighbours) {
    AlphaTexture t;
    t.image = imageOf(2, 2, {0, 65535, 65535, 0});
    t.wrapU = t.wrapV = Wrap::clampToEdge;
    EXPECT_DOUBLE_EQ(sampleBilinear(t, 1, 1), 0.5);
    EXPECT_DOUBLE_EQ(sampleBilinear(t, 0.75, 0.5), 0.25);
    EXPECT_DOUBLE_EQ(sampleBilinear(t, 0.75, 0.75), 0.25 * 0.75 + 0.75 * 0.25);
    EXPECT_DOUBLE_EQ(sampleBilinear(t, -5, 0), 0);
    t.wrapU = Wrap::repeat;
    EXPECT_DOUBLE_EQ(sampleBilinear(t, 0, 0), 0.5);
    EXPECT_DOUBLE_EQ(sampleBilinear(t, 2, 0), 0.5);
    t.wrapU = Wrap::mirroredRepeat;
    EXPECT_DOUBLE_EQ(sampleBilinear(t, 2, 0), 1);
}

TEST(Halve, EvenAxesAverageTwo) {
    const AlphaImage half = halve(imageOf(4, 2, {0, 10, 100, 200, 20, 30, 300, 400}));
    EXPECT_EQ(half.width, 2U);
    EXPECT_EQ(half.height, 1U);
    EXPECT_THAT(half.texels, ElementsAre(15, 250));
    EXPECT_EQ(half.steps, 65535U);
}

TEST(Halve, OddAxesUseThreeTaps) {
    // 5 texels to 2: weights (2, 2, 1) / 5 and (1, 2, 2) / 5.
    const AlphaImage half = halve(imageOf(5, 1, {100, 200, 300, 400, 500}));
    EXPECT_THAT(half.texels, ElementsAre(180, 420));
    EXPECT_THAT(halve(imageOf(1, 5, {100, 200, 300, 400, 500})).texels, ElementsAre(180, 420));
    EXPECT_THAT(halve(imageOf(3, 1, {0, 30, 90})).texels, ElementsAre(40));
    EXPECT_THAT(halve(imageOf(1, 1, {7})).texels, ElementsAre(7));
    EXPECT_THAT(halve(imageOf(2, 1, {1, 2})).texels, ElementsAre(2)) << "halves round up";
}

// Each source texel has the same weight in all, so the mean stays.
TEST(Halve, KeepsTheMean) {
    Random random(2);
    for (int round = 0; round < 50; ++round) {
        const AlphaImage image = random.texture(1 + random.below(17), 1 + random.below(17)).image;
        const AlphaImage half = halve(image);
        EXPECT_EQ(half.width, std::max(1U, image.width / 2));
        EXPECT_EQ(half.height, std::max(1U, image.height / 2));
        const auto mean = [](const AlphaImage& i) {
            return std::accumulate(i.texels.begin(), i.texels.end(), 0.0) /
                   static_cast<double>(i.texels.size());
        };
        EXPECT_NEAR(mean(half), mean(image), 0.5);
    }
}

TEST(Halve, ChainsEndAtOneTexel) {
    for (const uint32_t width : {1U, 2U, 3U, 64U, 65U}) {
        for (const uint32_t height : {1U, 5U, 127U}) {
            AlphaImage image = imageOf(width, height, std::vector<uint16_t>(size_t{width} * height, 1234));
            for (unsigned left = coarserLevels(image); left > 0; --left) {
                EXPECT_EQ(coarserLevels(image), left);
                image = halve(image);
            }
            EXPECT_EQ(image.width, 1U);
            EXPECT_EQ(image.height, 1U);
            EXPECT_EQ(image.texels[0], 1234);
        }
    }
}

}  // namespace
}  // namespace filigree::image
