#include "filigree/image/outline.h"

#include <gtest/gtest.h>

namespace filigree::image {
namespace {

AlphaTest mask(double cutoff, double factor = 1) {
    AlphaTest test;
    test.cutoff = cutoff;
    test.factor = factor;
    return test;
}

TEST(Thresholds, BetweenTexelsTheCutoffItself) {
    const auto thresholds = thresholdsOf(mask(0.5), 1, 255);
    ASSERT_EQ(thresholds.size(), 1U);
    EXPECT_EQ(thresholds[0].lowestOpaque, 128U * 257);
    EXPECT_EQ(thresholds[0].value, 32767.5);
    EXPECT_EQ(thresholdsOf(mask(0.5), 1, 65535)[0].lowestOpaque, 32768U);
}

TEST(Thresholds, ATexelOnTheCutoffIsOpaque) {
    for (unsigned a = 1; a < 256; ++a) {
        const auto thresholds = thresholdsOf(mask(a / 255.0), 1, 255);
        for (const Threshold& t : thresholds) {
            EXPECT_LE(t.value, t.lowestOpaque);
            EXPECT_GT(t.value, t.lowestOpaque - 257.0);
        }
        EXPECT_EQ(thresholds[0].lowestOpaque, a * 257) << a;
    }
}

TEST(Thresholds, FloatAndDoubleMayDisagreeThenBothCount) {
    // 0.7 * 0.5 in double is below the texel's 89.25 / 255; look for products that round apart.
    size_t apart = 0;
    for (unsigned a = 1; a < 256; ++a) {
        const double factor = 0.7;
        const auto thresholds = thresholdsOf(mask(a / 255.0 * factor, factor), 1, 255);
        ASSERT_LE(thresholds.size(), 2U);
        apart += thresholds.size() == 2 ? 1 : 0;
        const auto inFloat = [&](unsigned t) {
            return static_cast<float>(t) / 255.0F * 0.7F >= static_cast<float>(a / 255.0 * factor);
        };
        const auto inDouble = [&](unsigned t) { return t / 255.0 * factor >= a / 255.0 * factor; };
        for (unsigned t = 0; t < 256; ++t) {
            EXPECT_EQ(t * 257 >= thresholds.front().lowestOpaque, inDouble(t));
            EXPECT_EQ(t * 257 >= thresholds.back().lowestOpaque, inFloat(t));
        }
    }
    EXPECT_GT(apart, 0U);
}

TEST(Thresholds, EndsOfTheScale) {
    EXPECT_EQ(thresholdsOf(mask(0), 1, 255), std::vector({Threshold{0, -1}}));
    EXPECT_EQ(thresholdsOf(mask(1.5), 1, 255), std::vector({Threshold{65536, 65536}}));
    EXPECT_EQ(thresholdsOf(mask(1), 1, 255), std::vector({Threshold{65535, 65535}}));
    EXPECT_EQ(thresholdsOf(mask(0.5, 0), 1, 255), std::vector({Threshold{65536, 65536}}));
    EXPECT_EQ(thresholdsOf(mask(0, 0), 1, 255), std::vector({Threshold{0, -1}}));
    EXPECT_EQ(thresholdsOf(mask(0.5), 0.25, 255), std::vector({Threshold{65536, 65536}}));
}

TEST(Thresholds, BlendAsksForOneAndForZero) {
    AlphaTest blend;
    blend.mode = AlphaMode::blend;
    const auto full = thresholdsOf(blend, 1, 255);
    ASSERT_EQ(full.size(), 2U);
    EXPECT_EQ(full[0], (Threshold{65535, 65535}));
    EXPECT_EQ(full[1].lowestOpaque, 257U);
    EXPECT_GT(full[1].value, 0);
    EXPECT_LT(full[1].value, 1e-300);
    const auto half = thresholdsOf(blend, 0.5, 255);
    EXPECT_EQ(half[0].lowestOpaque, 65536U) << "never 1";
    EXPECT_EQ(half[1].lowestOpaque, 257U);
    EXPECT_EQ(thresholdsOf(blend, 0, 255)[1].lowestOpaque, 65536U) << "always 0";
    EXPECT_EQ(sideThreshold(blend, 1, 255).value, 32767.5);
    EXPECT_EQ(sideThreshold(blend, 0.5, 255).value, 65535);
    EXPECT_EQ(sideThreshold(mask(0.25), 1, 65535).value, 16383.75);
}

}  // namespace
}  // namespace filigree::image
