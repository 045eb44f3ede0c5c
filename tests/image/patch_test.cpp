#include "filigree/image/patch.h"

#include "textures.h"

#include <gtest/gtest.h>

namespace filigree::image {
namespace {

using tests::Random;

template <class Real>
PatchPolygon<Real> polygonOf(std::initializer_list<std::array<double, 2>> corners) {
    PatchPolygon<Real> polygon;
    for (const auto& c : corners) polygon.push({c[0], c[1]});
    return polygon;
}

template <class Real>
void expectRange(const Patch& patch, std::initializer_list<std::array<double, 2>> corners, double lower,
                 double upper) {
    const PatchRange range = rangeOver(patch, polygonOf<Real>(corners));
    EXPECT_EQ(range.lower, lower);
    EXPECT_EQ(range.upper, upper);
}

// Dyadic numbers lose nothing, so that Bounded ranges are exact.
TEST(Patch, RangesOverSimpleShapes) {
    const Patch slope = Patch::of(0, 100, 0, 100, 50);
    expectRange<Bounded>(slope, {{0, 0}, {1, 0}, {0, 1}}, -50, 50);
    expectRange<Bounded>(slope, {{0.25, 0}, {0.5, 0}, {0.25, 1}}, -25, 0);
    expectRange<double>(slope, {{0.25, 0}, {0.5, 0}, {0.25, 1}}, -25, 0);
    const Patch saddle = Patch::of(0, 100, 100, 0, 50);
    expectRange<Bounded>(saddle, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, -50, 50);
    expectRange<Bounded>(saddle, {{0, 0}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}}, -50, 0);
    expectRange<Bounded>(saddle, {{0.5, 0.5}}, 0, 0);
    expectRange<Bounded>(saddle, {{0.5, 0}, {0.5, 1}}, 0, 0);
    // Along the diagonal x = y the saddle is a parabola that turns in the middle.
    expectRange<Bounded>(saddle, {{0, 0}, {1, 1}}, -50, 0);
    expectRange<double>(saddle, {{0, 0}, {1, 1}}, -50, 0);
}

TEST(Patch, OnlyThePartInTheCellCounts) {
    const Patch slope = Patch::of(0, 100, 0, 100, 0);
    expectRange<Bounded>(slope, {{-3, 0.5}, {0.25, 0.5}}, 0, 25);
    expectRange<Bounded>(slope, {{0.5, -4}, {5, 0.5}, {0.5, 5}}, 50, 100);
    expectRange<Bounded>(slope, {{-8, -8}, {16, -8}, {-8, 16}}, 0, 100);
    EXPECT_TRUE(rangeOver(slope, polygonOf<Bounded>({{2, 0}, {3, 0}, {2, 1}})).empty());
    EXPECT_TRUE(rangeOver(slope, polygonOf<Bounded>({{1.5, -1}, {3, 1}})).empty());
    // Touching a side or a corner of the cell still counts.
    expectRange<Bounded>(slope, {{1, 0.5}, {2, 0}, {2, 1}}, 100, 100);
    expectRange<Bounded>(slope, {{-1, 1}, {0, 1}, {-1, 2}}, 0, 0);
}

// A polygon that ends on a side of the cell keeps that side exactly, whatever its other coordinates lose.
TEST(Patch, ACutKeepsItsSideExactly) {
    const Patch slope = Patch::of(100, 0, 100, 0, 100);
    const PatchRange range = rangeOver(slope, polygonOf<Bounded>({{-0.3, 0.1}, {0.7, 0.4}, {-0.9, 0.9}}));
    EXPECT_EQ(range.upper, 0) << "the greatest value lies on x = 0";
    EXPECT_LT(range.lower, -30);
}

TEST(Patch, TouchingIsExactWithBoundedOnly) {
    // The line x = 1/2 of this patch takes exactly the threshold.
    const Patch patch = Patch::of(0, 65535, 0, 65535, 32767.5);
    const PatchRange touching =
        rangeOver(patch, polygonOf<Bounded>({{0.5, 0.125}, {0.75, 0.5}, {0.5, 0.75}}));
    EXPECT_TRUE(touching.isOpaque());
    const double next = std::nextafter(0.5, 0.0);
    const PatchRange crossing =
        rangeOver(patch, polygonOf<Bounded>({{next, 0.125}, {0.75, 0.5}, {0.5, 0.75}}));
    EXPECT_FALSE(crossing.isOpaque());
    EXPECT_FALSE(crossing.isTransparent());
    // In double the tolerance leaves it open.
    const PatchRange rough =
        rangeOver(patch, polygonOf<double>({{0.5, 0.125}, {0.75, 0.5}, {0.5, 0.75}}), 1e-12);
    EXPECT_FALSE(rough.isOpaque(patchTolerance(patch, 1e-12)));
    EXPECT_FALSE(rough.isTransparent(patchTolerance(patch, 1e-12)));
}

// Against dense samples: the range encloses them, and its ends are reached nearly.
TEST(Patch, RandomPolygons) {
    Random random(3);
    for (int round = 0; round < 2000; ++round) {
        const auto texel = [&] { return static_cast<double>(random.below(65536)); };
        const Patch patch = Patch::of(texel(), texel(), texel(), texel(), texel());
        std::array<std::array<double, 2>, 3> c;
        for (auto& p : c) p = {random.between(-1, 2), random.between(-1, 2)};
        if (random.below(4) == 0) c[2] = c[1];
        const auto polygon = polygonOf<double>({c[0], c[1], c[2]});
        const PatchRange rough = rangeOver(patch, polygon);
        const PatchRange exact = rangeOver(patch, polygonOf<Bounded>({c[0], c[1], c[2]}));
        PatchRange sampled;
        constexpr int steps = 60;
        for (int a = 0; a <= steps; ++a) {
            for (int b = 0; a + b <= steps; ++b) {
                const double u = a / double{steps};
                const double v = b / double{steps};
                const PatchPoint<double> p{c[0][0] + u * (c[1][0] - c[0][0]) + v * (c[2][0] - c[0][0]),
                                           c[0][1] + u * (c[1][1] - c[0][1]) + v * (c[2][1] - c[0][1])};
                if (p.x >= 0 && p.x <= 1 && p.y >= 0 && p.y <= 1) sampled.add(patch.at(p));
            }
        }
        if (sampled.empty()) continue;
        ASSERT_LE(exact.lower, sampled.lower + 1e-6);
        ASSERT_GE(exact.upper, sampled.upper - 1e-6);
        ASSERT_LE(rough.lower, sampled.lower + 1e-6);
        ASSERT_GE(rough.upper, sampled.upper - 1e-6);
        ASSERT_NEAR(rough.lower, exact.lower, 1e-4);
        ASSERT_NEAR(rough.upper, exact.upper, 1e-4);
        ASSERT_LE(sampled.lower - exact.lower, 65535.0 * 0.2);
        ASSERT_LE(exact.upper - sampled.upper, 65535.0 * 0.2);
    }
}

TEST(PatchRange, AValueWithoutABoundIsEveryValue) {
    PatchRange range;
    range.add(Bounded(1) / (Bounded(1) / 3.0 * 3.0 - 1.0));
    EXPECT_FALSE(range.isOpaque());
    EXPECT_FALSE(range.isTransparent());
    PatchRange nothing;
    nothing.add(Bounded(0) / Bounded(0));
    EXPECT_FALSE(nothing.empty());
    EXPECT_FALSE(nothing.isOpaque() || nothing.isTransparent());
}

}  // namespace
}  // namespace filigree::image
