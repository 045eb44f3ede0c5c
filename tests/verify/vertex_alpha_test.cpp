#include "scenes.h"

#include <gtest/gtest.h>

namespace filigree::verify {
namespace {

using tests::blendTest;
using tests::maskTest;
using tests::texture8;

// Vertex alpha 0 at u = 0 and 1 at u = 1, over a constant texture.
mesh::UvTriangle ramp() {
    auto triangle = tests::triangleOf({0, 0}, {1, 0}, {0, 1});
    triangle.alpha = {0, 1, 0};
    return triangle;
}

TEST(VertexAlpha, TheRampIsMixedWhereItCrossesTheCutoff) {
    const auto texture = texture8(4, 4, [](uint32_t, uint32_t) { return 255; });
    const Judge judge(texture, maskTest(0.4));
    // Level 1: child 0 has alphas 0..1/2, child 2 1/2..1, child 3 0..1/2.
    EXPECT_EQ(judge.truth(ramp(), 1, 0), Truth::mixed);
    EXPECT_EQ(judge.truth(ramp(), 1, 2), Truth::opaque);
    EXPECT_EQ(Judge(texture, maskTest(0.6)).truth(ramp(), 1, 0), Truth::transparent);
    EXPECT_EQ(Judge(texture, maskTest(0.6)).truth(ramp(), 1, 2), Truth::mixed);
}

TEST(VertexAlpha, ProductsThatMeetTheCutoffAreUncertain) {
    const auto texture = texture8(4, 4, [](uint32_t, uint32_t) { return 255; });
    EXPECT_EQ(Judge(texture, maskTest(0.5)).truth(ramp(), 1, 2), Truth::uncertain);
}

TEST(VertexAlpha, SubdivisionSeesWhatOneBoundCannot) {
    // The texture falls where the vertex alpha rises: the bound 1 * 1 is far above the true product.
    auto texture = texture8(64, 1, [](uint32_t x, uint32_t) { return 255 - 4 * x; });
    texture.wrapU = image::Wrap::clampToEdge;
    EXPECT_EQ(tests::wholeTruth(ramp(), texture, maskTest(0.3)), Truth::transparent);  // at most about 1/4
    EXPECT_EQ(tests::wholeTruth(ramp(), texture, maskTest(0.2)), Truth::mixed);
}

TEST(VertexAlpha, BlendIsTransparentWhereTheTextureIsClear) {
    const auto texture = texture8(4, 4, [](uint32_t, uint32_t) { return 0; });
    EXPECT_EQ(tests::wholeTruth(ramp(), texture, blendTest()), Truth::transparent);
    const auto opaque = texture8(4, 4, [](uint32_t, uint32_t) { return 255; });
    EXPECT_EQ(tests::wholeTruth(ramp(), opaque, blendTest()), Truth::mixed);
}

TEST(VertexAlpha, NearestAndMipsCountToo) {
    auto texture = texture8(4, 4, [](uint32_t x, uint32_t) { return x < 2 ? 255 : 0; });
    texture.filter = image::Filter::both;
    auto triangle = tests::triangleInTexels(texture, {0.75F, 0}, {1.25F, 0}, {1, 1});
    triangle.alpha = {1, 0.9F, 0.8F};
    auto test = maskTest(0.5);
    EXPECT_EQ(tests::wholeTruth(triangle, texture, test), Truth::opaque);
    test.mips = 2;
    EXPECT_EQ(tests::wholeTruth(triangle, texture, test), Truth::mixed)
        << "the 1x1 level is 1/2, times less than 1";
}

}  // namespace
}  // namespace filigree::verify
