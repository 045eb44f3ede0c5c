// Patterns whose truths are known exactly.
#include "filigree/micromap/curve.h"

#include "scenes.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace filigree::verify {
namespace {

using image::Filter;
using image::Wrap;
using tests::blendTest;
using tests::maskTest;
using tests::texture16;
using tests::texture8;
using tests::triangleInTexels;
using tests::triangleOf;
using tests::wholeTruth;

// Opaque left half, transparent right half, of a texture of `width` texels; along u the 0.5-contour is in the
// middle.
image::AlphaTexture step(uint32_t width) {
    auto texture = texture8(width, 2, [&](uint32_t x, uint32_t) { return x < width / 2 ? 255 : 0; });
    texture.wrapU = Wrap::clampToEdge;
    return texture;
}

TEST(Truth, ConstantTexturesAreUniformEverywhere) {
    for (const uint32_t size : {1U, 3U, 8U}) {
        const auto opaque = texture8(size, size, [](uint32_t, uint32_t) { return 200; });
        const auto clear = texture8(size, size, [](uint32_t, uint32_t) { return 20; });
        const auto triangle = triangleOf({-7.3F, 2.1F}, {9, 4}, {0.2F, -55});
        EXPECT_EQ(wholeTruth(triangle, opaque, maskTest()), Truth::opaque);
        EXPECT_EQ(wholeTruth(triangle, clear, maskTest()), Truth::transparent);
    }
}

TEST(Truth, TouchingTheContourCountsAsGlTfSays) {
    const auto texture =
        step(8);  // between texel centres 3.5 and 4.5 alpha falls from 1 to 0; it is 1/2 at 4
    const auto left = triangleInTexels(texture, {4, 0.2F}, {4, 1.7F}, {2, 1});
    const auto right = triangleInTexels(texture, {4, 0.2F}, {4, 1.7F}, {6, 1});
    EXPECT_EQ(wholeTruth(left, texture, maskTest()), Truth::opaque)
        << "alpha == cutoff on its edge is opaque";
    EXPECT_EQ(wholeTruth(right, texture, maskTest()), Truth::mixed)
        << "its edge is opaque, its inside is not";
    const auto past = triangleInTexels(texture, {std::nextafter(4.0F, 5.0F), 0.2F}, {5, 1.7F}, {6, 1});
    EXPECT_EQ(wholeTruth(past, texture, maskTest()), Truth::transparent);
    const auto over = triangleInTexels(texture, {std::nextafter(4.0F, 5.0F), 0.2F}, {3, 1.7F}, {2, 1});
    EXPECT_EQ(wholeTruth(over, texture, maskTest()), Truth::mixed);
}

TEST(Truth, TheRampCrossesAnyCutoffWhereItShould) {
    // 16-bit texels 0, 1000, 2000, ...: alpha at texel coordinate x is (x - 0.5) * 1000 / 65535.
    auto texture = texture16(64, 1, [](uint32_t x, uint32_t) { return 1000 * x; });
    texture.wrapU = Wrap::clampToEdge;
    for (const double place : {3.0, 17.25, 40.5}) {
        const double cutoff = (place - 0.5) * 1000 / 65535;
        const auto x = static_cast<float>(place);
        const auto below = triangleInTexels(texture, {x - 2, 0}, {x - 1 / 64.0F, 1}, {x - 1, 3});
        const auto above = triangleInTexels(texture, {x + 2, 0}, {x + 1 / 64.0F, 1}, {x + 1, 3});
        const auto across = triangleInTexels(texture, {x - 1 / 64.0F, 0}, {x + 1 / 64.0F, 1}, {x, 3});
        EXPECT_EQ(wholeTruth(below, texture, maskTest(cutoff)), Truth::transparent);
        EXPECT_EQ(wholeTruth(above, texture, maskTest(cutoff)), Truth::opaque);
        EXPECT_EQ(wholeTruth(across, texture, maskTest(cutoff)), Truth::mixed);
    }
}

TEST(Truth, OneOpaqueTexelReachesHalfWayToItsNeighbours) {
    auto texture = texture8(8, 8, [](uint32_t x, uint32_t y) { return x == 4 && y == 4 ? 255 : 0; });
    // Alpha is (1 - |x - 4.5|)(1 - |y - 4.5|): along the axes it is 1/2 at a distance of 1/2.
    EXPECT_EQ(wholeTruth(triangleInTexels(texture, {4, 4.5F}, {5, 4.5F}, {4.5F, 4.5F}), texture, maskTest()),
              Truth::opaque);
    EXPECT_EQ(wholeTruth(triangleInTexels(texture, {4, 4.5F}, {4.5F, 4}, {5, 4.5F}), texture, maskTest()),
              Truth::opaque)
        << "the contour bends outward of the straight line";
    EXPECT_EQ(wholeTruth(triangleInTexels(texture, {4.25F, 4.5F}, {4.5F, 4.25F}, {4.75F, 4.75F}), texture,
                         maskTest()),
              Truth::opaque);
    EXPECT_EQ(wholeTruth(triangleInTexels(texture, {3.99F, 4.5F}, {3, 4}, {3, 5}), texture, maskTest()),
              Truth::transparent);
    EXPECT_EQ(wholeTruth(triangleInTexels(texture, {2, 2}, {7, 2.5F}, {4.5F, 7.5F}), texture, maskTest()),
              Truth::mixed)
        << "the texel is inside, the edges do not meet its contour";
}

TEST(Truth, ASaddlesParabolaDecidesAnEdge) {
    // One cell with corners 255, 0 / 0, 255: along the diagonal between the low corners alpha is 1/2 at most
    // in the middle, where it is exactly 1/2.
    auto texture = texture8(2, 2, [](uint32_t x, uint32_t y) { return x == y ? 255 : 0; });
    texture.wrapU = texture.wrapV = Wrap::clampToEdge;
    const auto anti = triangleInTexels(texture, {1.5F, 0.5F}, {0.5F, 1.5F}, {1, 1});
    EXPECT_EQ(wholeTruth(anti, texture, maskTest(0.5)), Truth::mixed);
    EXPECT_EQ(wholeTruth(anti, texture, maskTest(std::nextafter(0.5, 1))), Truth::transparent);
    const auto main = triangleInTexels(texture, {0.5F, 0.5F}, {1.5F, 1.5F}, {1, 1});
    EXPECT_EQ(wholeTruth(main, texture, maskTest(0.5)), Truth::opaque);
    EXPECT_EQ(wholeTruth(main, texture, maskTest(std::nextafter(0.5, 1))), Truth::mixed);
}

TEST(Truth, AnAlignedCheckerIsJudgedExactlyAtEveryMicroTriangle) {
    // 0/255 columns two texels wide: the contours lie on even texel coordinates, as do micro-triangle edges.
    const auto texture = texture8(16, 16, [](uint32_t x, uint32_t) { return x / 2 % 2 == 0 ? 255 : 0; });
    const auto triangle = triangleInTexels(texture, {0, 0}, {16, 0}, {0, 16});
    for (uint32_t m = 0; m < 64; ++m) {
        const auto place = micromap::latticeTriangle(m, 3);
        const bool opaque = place.i % 2 == 0;  // it spans texels 2i .. 2i + 2
        EXPECT_EQ(truthOf(triangle, 3, m, texture, maskTest()), opaque ? Truth::opaque : Truth::mixed) << m;
        const Truth finer = truthOf(triangle, 3, m, texture, maskTest(std::nextafter(0.5, 1)));
        EXPECT_EQ(finer, opaque ? Truth::mixed : Truth::transparent) << m;
    }
}

TEST(Truth, ADiscIsOpaqueInsideAndClearOutside) {
    const auto texture = texture8(64, 64, [](uint32_t x, uint32_t y) {
        const double distance = std::hypot(x + 0.5 - 32, y + 0.5 - 32);
        return static_cast<unsigned>(std::lround(255 * std::clamp(20.5 - distance, 0.0, 1.0)));
    });
    const auto triangle = triangleInTexels(texture, {0, 0}, {64, 0}, {0, 64});
    const Judge judge(texture, maskTest());
    for (uint32_t m = 0; m < 1024; ++m) {
        double nearest = 1e9;
        double farthest = 0;
        for (const auto p : micromap::corners(micromap::latticeTriangle(m, 5))) {
            const double distance = std::hypot(2.0 * p.i - 32, 2.0 * p.j - 32);
            nearest = std::min(nearest, distance);
            farthest = std::max(farthest, distance);
        }
        const Truth truth = judge.truth(triangle, 5, m);
        EXPECT_TRUE(truth == Truth::opaque || farthest >= 19) << m;
        EXPECT_TRUE(truth == Truth::transparent || nearest <= 22.5) << m;
        EXPECT_TRUE(truth == Truth::mixed || nearest >= 18.5 || farthest <= 21.5) << m;
    }
}

TEST(Truth, WrapModesSayWhatLiesAcrossTheSeam) {
    // Left texel opaque, the others clear; a triangle just right of the image.
    auto texture = texture8(5, 1, [](uint32_t x, uint32_t) { return x == 0 ? 255 : 0; });
    const auto right = triangleInTexels(texture, {5.25F, 0}, {5.75F, 0}, {5.5F, 1});
    const auto left = triangleInTexels(texture, {-0.75F, 0}, {-0.25F, 0}, {-0.5F, 1});
    const auto expect = [&](Wrap wrap, Truth atRight, Truth atLeft) {
        texture.wrapU = wrap;
        EXPECT_EQ(wholeTruth(right, texture, maskTest()), atRight);
        EXPECT_EQ(wholeTruth(left, texture, maskTest()), atLeft);
    };
    expect(Wrap::repeat, Truth::opaque, Truth::transparent);
    expect(Wrap::mirroredRepeat, Truth::transparent, Truth::opaque);
    expect(Wrap::clampToEdge, Truth::transparent, Truth::opaque);
}

TEST(Truth, MirroringReflectsEveryOtherCopy) {
    auto texture = texture8(4, 1, [](uint32_t x, uint32_t) { return x < 2 ? 255 : 0; });
    texture.wrapU = Wrap::mirroredRepeat;
    for (int copy = -3; copy <= 3; ++copy) {
        const bool reflected = copy % 2 != 0;
        const float start = 4.0F * static_cast<float>(copy);
        const auto first = triangleInTexels(texture, {start, 0}, {start + 1, 0}, {start + 1.5F, 1});
        EXPECT_EQ(wholeTruth(first, texture, maskTest()), reflected ? Truth::transparent : Truth::opaque)
            << copy;
    }
}

TEST(Truth, AThousandPeriodsAreNoTrouble) {
    auto texture = texture8(16, 16, [](uint32_t x, uint32_t y) { return x == 3 && y == 5 ? 0 : 255; });
    EXPECT_EQ(wholeTruth(triangleOf({0, 0}, {1000, 0}, {0, 1000}), texture, maskTest()), Truth::mixed);
    // A sliver along row 12 of every copy meets no hole, one along row 5 does.
    EXPECT_EQ(wholeTruth(triangleInTexels(texture, {0, 12}, {16000, 12}, {8000, 12.5F}), texture, maskTest()),
              Truth::opaque);
    EXPECT_EQ(wholeTruth(triangleInTexels(texture, {0, 5.5F}, {16000, 5.5F}, {8000, 6}), texture, maskTest()),
              Truth::mixed);
    const float far = 4096;
    EXPECT_EQ(
        wholeTruth(triangleOf({far, far}, {far + 0.125F, far}, {far, far + 0.25F}), texture, maskTest()),
        Truth::opaque);
}

TEST(Truth, CoordinatesBeyondReachAreUncertainAndUniformTexturesAreNot) {
    const auto mixed = texture8(4, 4, [](uint32_t x, uint32_t) { return x == 0 ? 255 : 0; });
    const auto opaque = texture8(4, 4, [](uint32_t, uint32_t) { return 255; });
    const auto huge = triangleOf({0, 0}, {1e30F, 0}, {0, 1e30F});
    EXPECT_EQ(wholeTruth(huge, mixed, maskTest()), Truth::uncertain);
    EXPECT_EQ(wholeTruth(triangleOf({0, 0}, {1e9F, 0}, {0, 1e9F}), opaque, maskTest()), Truth::opaque);
}

TEST(Truth, TheGuardWidensBySquares) {
    const auto texture = step(8);
    const double guard = 0.25;
    const auto near = triangleInTexels(texture, {3.8125F, 0.2F}, {3, 1.7F}, {2, 1});
    const auto touching = triangleInTexels(texture, {3.75F, 0.2F}, {3, 1.7F}, {2, 1});
    EXPECT_EQ(wholeTruth(near, texture, maskTest(0.5, 0)), Truth::opaque);
    EXPECT_EQ(wholeTruth(near, texture, maskTest(0.5, guard)), Truth::mixed);
    EXPECT_EQ(wholeTruth(touching, texture, maskTest(0.5, guard)), Truth::opaque);
    EXPECT_EQ(wholeTruth(touching, texture, maskTest(0.5, std::nextafter(guard, 1))), Truth::mixed);
    // The square's corner, not only its axes: at (4.5, 4.5) of a clear texture sits one opaque texel.
    const auto dot = texture8(9, 9, [](uint32_t x, uint32_t y) { return x == 4 && y == 4 ? 255 : 0; });
    const auto away = triangleInTexels(dot, {3.5F, 3.5F}, {3, 2}, {2, 3});
    EXPECT_EQ(wholeTruth(away, dot, maskTest(0.25, 0.4375)), Truth::transparent);  // 0.4375^2 < 1/4
    EXPECT_EQ(wholeTruth(away, dot, maskTest(0.25, 0.5)), Truth::mixed);           // 0.5^2 == 1/4
}

TEST(Truth, GuardsCountTexelsOfEachMip) {
    // Level 0 is clear left of x = 8; at level 1 the contour is at texel 4 of 8, so 0.25 texels are 0.5 of
    // level 0.
    auto texture = texture8(16, 16, [](uint32_t x, uint32_t) { return x < 8 ? 0 : 255; });
    texture.wrapU = Wrap::clampToEdge;
    const auto triangle = triangleInTexels(texture, {7.625F, 1}, {6, 3}, {6, 1});
    auto test = maskTest(0.5, 0.25);
    EXPECT_EQ(wholeTruth(triangle, texture, test), Truth::transparent);
    test.mips = 1;
    EXPECT_EQ(wholeTruth(triangle, texture, test), Truth::mixed);
}

TEST(Truth, CoarserMipsMustAgree) {
    // One clear texel in a block of opaque ones: level 1 averages it to 3/4, level 2 keeps the rest at 15/16.
    const auto texture = texture8(
        4, 4, [](uint32_t x, uint32_t y) { return x < 2 && y < 2 ? (x + y == 0 ? 255U : 0U) : 255U; });
    const auto corner = triangleInTexels(texture, {0.5F, 0.5F}, {0.55F, 0.5F}, {0.5F, 0.55F});
    auto test = maskTest(0.5);
    EXPECT_EQ(wholeTruth(corner, texture, test), Truth::opaque);
    test.mips = 1;  // 1/4 at the texel's centre (1, 1)
    const auto centre = triangleInTexels(texture, {1, 1}, {1.05F, 1}, {1, 1.05F});
    EXPECT_EQ(wholeTruth(centre, texture, maskTest(0.5)), Truth::transparent);
    EXPECT_EQ(wholeTruth(centre, texture, test), Truth::transparent);
    test.mips = 2;  // the 1x1 level is 13/16
    EXPECT_EQ(wholeTruth(centre, texture, test), Truth::mixed);
    test.mips = 50;  // there are no more
    EXPECT_EQ(wholeTruth(centre, texture, test), Truth::mixed);
}

TEST(Truth, NearestCountsEveryTexelThatIsTouched) {
    auto texture = texture8(8, 8, [](uint32_t x, uint32_t) { return x < 4 ? 255 : 0; });
    texture.filter = Filter::nearest;
    const auto inside = triangleInTexels(texture, {1, 1}, {3.99F, 1}, {1, 7});
    const auto touching = triangleInTexels(texture, {1, 1}, {4, 1}, {1, 7});
    EXPECT_EQ(wholeTruth(inside, texture, maskTest()), Truth::opaque);
    EXPECT_EQ(wholeTruth(touching, texture, maskTest()), Truth::mixed);
    EXPECT_EQ(wholeTruth(inside, texture, maskTest(0.5, 0.0625)), Truth::mixed);
    const auto seam = triangleInTexels(texture, {0, 1}, {1, 1}, {1, 2});
    EXPECT_EQ(wholeTruth(seam, texture, maskTest()), Truth::mixed) << "texel -1, which is 7, is touched";
    texture.wrapU = Wrap::clampToEdge;
    EXPECT_EQ(wholeTruth(seam, texture, maskTest()), Truth::opaque);
}

TEST(Truth, NearestSeesACornerTouchedByASlantedEdge) {
    auto texture = texture8(8, 8, [](uint32_t x, uint32_t y) { return x == 4 && y == 4 ? 0 : 255; });
    texture.filter = Filter::nearest;
    // The line through (3, 5) and (5, 3) passes through (4, 4), the texel's corner.
    EXPECT_EQ(wholeTruth(triangleInTexels(texture, {3, 5}, {5, 3}, {2, 2}), texture, maskTest()),
              Truth::mixed);
    const float less = std::nextafter(5.0F, 0.0F);
    EXPECT_EQ(wholeTruth(triangleInTexels(texture, {3, less}, {5, std::nextafter(3.0F, 0.0F)}, {2, 2}),
                         texture, maskTest()),
              Truth::opaque);
}

TEST(Truth, BothFiltersMustAgree) {
    auto texture = texture8(8, 8, [](uint32_t x, uint32_t) { return x < 4 ? 255 : 0; });
    texture.wrapU = Wrap::clampToEdge;
    const auto triangle = triangleInTexels(texture, {3.6F, 1}, {3.8F, 1}, {3.7F, 2});
    const auto test = maskTest(0.75);  // linear filtering falls below it at x = 3.75
    texture.filter = Filter::nearest;
    EXPECT_EQ(wholeTruth(triangle, texture, test), Truth::opaque);
    texture.filter = Filter::linear;
    EXPECT_EQ(wholeTruth(triangle, texture, test), Truth::mixed);
    texture.filter = Filter::both;
    EXPECT_EQ(wholeTruth(triangle, texture, test), Truth::mixed);
    EXPECT_EQ(wholeTruth(triangleInTexels(texture, {1, 1}, {3, 1}, {2, 2}), texture, test), Truth::opaque);
    const auto split = triangleInTexels(texture, {3.8F, 1}, {3.9F, 1}, {3.85F, 2});
    EXPECT_EQ(wholeTruth(split, texture, test), Truth::mixed)
        << "opaque by one filter, transparent by the other";
}

TEST(Truth, BlendIsKnownOnlyAtTheEndsOfTheScale) {
    const auto texture = texture8(16, 1, [](uint32_t x, uint32_t) {
        return x < 4 ? 255U : x < 8 ? 0U : x < 12 ? 128U : 254U;
    });
    const auto at = [&](float from, float to) {
        return wholeTruth(triangleInTexels(texture, {from, 0}, {to, 0}, {to, 1}), texture, blendTest());
    };
    EXPECT_EQ(at(1, 2), Truth::opaque);
    EXPECT_EQ(at(0.5F, 3.5F), Truth::opaque) << "up to the last opaque texel's centre";
    EXPECT_EQ(at(0.5F, std::nextafter(3.5F, 4.0F)), Truth::mixed);
    EXPECT_EQ(at(4.5F, 7.5F), Truth::transparent);
    EXPECT_EQ(at(4.5F, std::nextafter(7.5F, 8.0F)), Truth::mixed);
    EXPECT_EQ(at(9, 10), Truth::mixed);
    EXPECT_EQ(at(13, 14), Truth::mixed);
    auto half = blendTest();
    half.factor = 0.5;
    EXPECT_EQ(wholeTruth(triangleInTexels(texture, {1, 0}, {2, 0}, {2, 1}), texture, half), Truth::mixed);
    half.factor = 0;
    EXPECT_EQ(wholeTruth(triangleInTexels(texture, {1, 0}, {9, 0}, {2, 1}), texture, half),
              Truth::transparent);
}

TEST(Truth, FactorsScaleTheAlpha) {
    const auto texture = step(8);
    auto test = maskTest(0.25);
    test.factor = 0.5;  // alpha 1/2 is the border again
    EXPECT_EQ(wholeTruth(triangleInTexels(texture, {4, 0}, {4, 1}, {2, 1}), texture, test), Truth::opaque);
    EXPECT_EQ(wholeTruth(triangleInTexels(texture, {4, 0}, {4, 1}, {6, 1}), texture, test), Truth::mixed);
    test.cutoff = 0.75;
    EXPECT_EQ(wholeTruth(triangleInTexels(texture, {4, 0}, {4, 1}, {2, 1}), texture, test),
              Truth::transparent);
    test.cutoff = 0;
    EXPECT_EQ(wholeTruth(triangleInTexels(texture, {4, 0}, {4, 1}, {2, 1}), texture, test), Truth::opaque);
    test.factor = 0;
    EXPECT_EQ(wholeTruth(triangleInTexels(texture, {4, 0}, {4, 1}, {2, 1}), texture, test), Truth::opaque);
    test.cutoff = 0.01;
    EXPECT_EQ(wholeTruth(triangleInTexels(texture, {4, 0}, {4, 1}, {2, 1}), texture, test),
              Truth::transparent);
}

TEST(Truth, ACutoffAboveOneIsTransparentAndOneNeedsFullAlpha) {
    const auto texture = step(8);
    const auto left = triangleInTexels(texture, {3.5F, 0}, {1, 1}, {2, 1});
    EXPECT_EQ(wholeTruth(left, texture, maskTest(1.5)), Truth::transparent);
    EXPECT_EQ(wholeTruth(left, texture, maskTest(1)), Truth::opaque);
    const auto more = triangleInTexels(texture, {std::nextafter(3.5F, 4.0F), 0}, {1, 1}, {2, 1});
    EXPECT_EQ(wholeTruth(more, texture, maskTest(1)), Truth::mixed);
}

TEST(Truth, TexelsOnTheCutoffWithinFloatRoundingAreUncertain) {
    // 51 / 255 is 0.2, which doubles do not hold: single and double precision say opaque, exact numbers do
    // not.
    const auto texture = texture8(8, 1, [](uint32_t x, uint32_t) { return x < 4 ? 51U : 255U; });
    const auto test = maskTest(0.2);
    const auto at = [&](float from, float to) {
        return wholeTruth(triangleInTexels(texture, {from, 0}, {to, 0}, {to, 1}), texture, test);
    };
    EXPECT_EQ(at(1, 2), Truth::uncertain);
    EXPECT_EQ(at(2, 5), Truth::uncertain) << "opaque where not on the cutoff";
    EXPECT_EQ(at(5, 6), Truth::opaque);
    const auto clear = texture8(8, 1, [](uint32_t x, uint32_t) { return x < 4 ? 50U : 255U; });
    EXPECT_EQ(wholeTruth(triangleInTexels(clear, {1, 0}, {2, 0}, {2, 1}), clear, test), Truth::transparent);
    EXPECT_EQ(wholeTruth(triangleInTexels(clear, {2, 0}, {5, 0}, {2, 1}), clear, test), Truth::mixed);
}

TEST(Truth, LinesAndPointsAreJudgedAlongThemselves) {
    const auto texture = step(8);
    const auto line = [&](float from, float to) {
        return triangleInTexels(texture, {from, 0.3F}, {to, 0.3F}, {(from + to) / 2, 0.3F});
    };
    EXPECT_EQ(wholeTruth(line(1, 4), texture, maskTest()), Truth::opaque);
    EXPECT_EQ(wholeTruth(line(1, 4.25F), texture, maskTest()), Truth::mixed);
    EXPECT_EQ(wholeTruth(line(4.25F, 6), texture, maskTest()), Truth::transparent);
    EXPECT_EQ(wholeTruth(line(2, 2), texture, maskTest()), Truth::opaque);
    EXPECT_EQ(wholeTruth(line(4, 4), texture, maskTest()), Truth::opaque);
    EXPECT_EQ(wholeTruth(line(5, 5), texture, maskTest()), Truth::transparent);
    EXPECT_EQ(wholeTruth(line(3.75F, 3.75F), texture, maskTest(0.5, 0.25)), Truth::opaque);
    EXPECT_EQ(wholeTruth(line(3.75F, 3.75F), texture, maskTest(0.5, 0.3125)), Truth::mixed);
    EXPECT_EQ(wholeTruth(line(1, 3.75F), texture, maskTest(0.5, 0.25)), Truth::opaque);
    EXPECT_EQ(wholeTruth(line(1, 3.75F), texture, maskTest(0.5, 0.3125)), Truth::mixed);
    auto nearest = texture;
    nearest.filter = Filter::nearest;
    EXPECT_EQ(wholeTruth(line(3.5F, 3.5F), nearest, maskTest()), Truth::opaque);
    EXPECT_EQ(wholeTruth(line(4, 4), nearest, maskTest()), Truth::mixed);
}

TEST(Truth, NumbersThatAreNoneAreMixed) {
    const auto texture = texture8(2, 2, [](uint32_t, uint32_t) { return 255; });
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(wholeTruth(triangleOf({0, 0}, {nan, 0}, {0, 1}), texture, maskTest()), Truth::mixed);
    EXPECT_EQ(wholeTruth(triangleOf({0, 0}, {1, 0}, {0, -infinity}), texture, maskTest()), Truth::mixed);
    auto shaded = triangleOf({0, 0}, {1, 0}, {0, 1});
    shaded.alpha[1] = nan;
    EXPECT_EQ(wholeTruth(shaded, texture, maskTest()), Truth::mixed);
}

TEST(Truth, ConstantVertexAlphaIsAFactor) {
    const auto texture = step(8);
    auto left = triangleInTexels(texture, {4, 0}, {4, 1}, {2, 1});
    left.alpha = {0.5F, 0.5F, 0.5F};
    EXPECT_EQ(wholeTruth(left, texture, maskTest(0.25)), Truth::opaque);
    EXPECT_EQ(wholeTruth(left, texture, maskTest(0.5)), Truth::mixed);
    EXPECT_EQ(wholeTruth(left, texture, maskTest(0.75)), Truth::transparent);
    left.alpha = {0, 0, 0};
    EXPECT_EQ(wholeTruth(left, texture, maskTest(0.25)), Truth::transparent);
    EXPECT_EQ(wholeTruth(left, texture, maskTest(0)), Truth::opaque);
}

TEST(Truth, OddSizesInterpolateAcrossTheirSeam) {
    // Three texels 255, 0, 0 that repeat: between 2.5 and 3.5 (which is 0.5) alpha rises from 0 to 1.
    const auto texture = texture8(3, 1, [](uint32_t x, uint32_t) { return x == 0 ? 255 : 0; });
    const auto at = [&](float from, float to) {
        return wholeTruth(triangleOf({from / 3, 0}, {to / 3, 0.2F}, {to / 3, 7}), texture, maskTest());
    };
    EXPECT_EQ(at(3.01F, 3.9F), Truth::opaque);
    EXPECT_EQ(at(1.1F, 2.9F), Truth::transparent);
    EXPECT_EQ(at(2.9F, 3.1F), Truth::mixed);
    EXPECT_EQ(at(3.01F + 300, 3.9F + 300), Truth::opaque);
    EXPECT_EQ(at(1.1F - 300, 2.9F - 300), Truth::transparent);
}

TEST(OpaqueShare, CountsTheAreaThatIsOpaque) {
    const auto texture = step(8);
    const auto triangle = triangleInTexels(texture, {0, 0}, {8, 0}, {0, 2});
    EXPECT_NEAR(opaqueShare(triangle, 0, 0, texture, maskTest(), 200), 0.75, 0.01);
    const auto place = micromap::LatticeTriangle{0, 0, true};  // corners (4, 1), (0, 1), (4, 0) in texels
    EXPECT_EQ(opaqueShare(triangle, 1, micromap::curveIndex(place, 1), texture, maskTest(), 20), 1);
    const auto right = micromap::LatticeTriangle{1, 0, false};
    EXPECT_EQ(opaqueShare(triangle, 1, micromap::curveIndex(right, 1), texture, maskTest(), 20), 0);
    auto nearest = texture;
    nearest.filter = Filter::nearest;
    EXPECT_NEAR(opaqueShare(triangle, 0, 0, nearest, blendTest(), 200), 0.75, 0.01);
}

}  // namespace
}  // namespace filigree::verify
