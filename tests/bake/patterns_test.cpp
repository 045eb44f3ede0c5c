// Patterns whose states are known exactly.
#include "filigree/micromap/curve.h"

#include "baking.h"

#include <cmath>
#include <functional>
#include <limits>

namespace filigree::bake::tests {
namespace {

using image::Filter;
using image::Wrap;

// Where a micro-triangle lies along the first edge of its triangle: from `low` to `high`, in texels, when the
// first edge runs from x0 to x1 and the third corner lies at x0.
struct Extent {
    double low;
    double high;
};
Extent alongFirstEdge(uint32_t micro, unsigned level, double x0, double x1) {
    const auto corners = micromap::corners(micromap::latticeTriangle(micro, level));
    const auto [least, most] = std::minmax({corners[0].i, corners[1].i, corners[2].i});
    const double step = (x1 - x0) / static_cast<double>(1U << level);
    return {x0 + least * step, x0 + most * step};
}

// A right triangle over texels x0..x1 of a texture whose alpha does not depend on y.
mesh::UvTriangle strip(const image::AlphaTexture& texture, float x0, float x1) {
    return triangleInTexels(texture, {x0, 0}, {x1, 0}, {x0, 1});
}

// Opaque left half, transparent right half, 8 texels wide: the contour of 1/2 lies at x = 4, and with
// `repeat` at x = 0.
image::AlphaTexture halves(Wrap wrap) {
    auto texture = texture8(8, 2, [](uint32_t x, uint32_t) { return x < 4 ? 255 : 0; });
    texture.wrapU = wrap;
    return texture;
}

// What a strip must come to when it is opaque at x exactly where isOpaque(x) says, a closed set with ends at
// whole numbers, and micro-triangles end at whole or half numbers.
void expectStrip(const std::vector<State>& states, unsigned level, double x0, double x1, double guard,
                 const std::function<bool(double)>& isOpaque) {
    for (uint32_t k = 0; k < states.size(); ++k) {
        const Extent e = alongFirstEdge(k, level, x0, x1);
        bool opaque = true;
        bool transparent = true;
        for (double x = e.low - guard; x <= e.high + guard; x += 0.25) {
            opaque = opaque && isOpaque(x);
            transparent = transparent && !isOpaque(x);
        }
        const bool known = micromap::isKnown(states[k]);
        EXPECT_EQ(known, opaque || transparent)
            << "micro-triangle " << k << ", x " << e.low << ".." << e.high;
        if (opaque || transparent) {
            EXPECT_EQ(states[k], micromap::knownOf(opaque)) << k;
        }
    }
}

double inPeriod(double x, double period) {
    return x - std::floor(x / period) * period;
}

TEST(Patterns, HalfPlaneTouchesCountAsGlTfSays) {
    const auto texture = halves(Wrap::clampToEdge);
    const auto isOpaque = [](double x) { return x <= 4; };
    for (const unsigned level : {3U, 4U}) {
        expectStrip(bakeOne(strip(texture, 0, 8), texture, maskTest(), level), level, 0, 8, 0, isOpaque);
    }
}

TEST(Patterns, SeamsFollowTheWrapMode) {
    const auto repeated = [](double x) { return inPeriod(x, 8) <= 4; };
    const auto mirrored = [](double x) { return inPeriod(x, 16) <= 4 || inPeriod(x, 16) >= 12; };
    const auto clamped = [](double x) { return x <= 4; };
    const auto check = [](Wrap wrap, float x0, float x1, const std::function<bool(double)>& isOpaque) {
        const auto texture = halves(wrap);
        expectStrip(bakeOne(strip(texture, x0, x1), texture, maskTest(), 5), 5, x0, x1, 0, isOpaque);
    };
    for (const float x0 : {-16.0F, -8.0F, 0.0F, 8.0F, -800.0F, 1600.0F}) {
        check(Wrap::repeat, x0, x0 + 16, repeated);
        check(Wrap::mirroredRepeat, x0, x0 + 16, mirrored);
        check(Wrap::clampToEdge, x0, x0 + 16, clamped);
    }
}

TEST(Patterns, TheGuardKeepsItsDistance) {
    const auto texture = halves(Wrap::clampToEdge);
    for (const double guard : {0.25, 0.5, 1.0, 2.5}) {
        const auto states = bakeOne(strip(texture, 0, 8), texture, maskTest(0.5, guard), 4);
        expectStrip(states, 4, 0, 8, guard, [](double x) { return x <= 4; });
    }
}

// Texel squares that meet in saddles exactly at the cutoff: linear alpha is >= 1/2 on the closed opaque
// squares, and every transparent square touches one.
TEST(Patterns, CheckerOnItsOwnGrid) {
    auto texture = texture8(8, 8, [](uint32_t x, uint32_t y) { return (x + y) % 2 == 0 ? 255 : 0; });
    const auto triangle = triangleInTexels(texture, {0, 0}, {8, 0}, {0, 8});
    for (const Filter filter : {Filter::linear, Filter::nearest, Filter::both}) {
        texture.filter = filter;
        const auto states = bakeOne(triangle, texture, maskTest(), 3);
        for (uint32_t k = 0; k < states.size(); ++k) {
            const auto t = micromap::latticeTriangle(k, 3);
            const bool opaque = (t.i + t.j) % 2 == 0;
            // Under nearest filtering squares are closed, so that all touch texels of the other side.
            const bool known = opaque && filter == Filter::linear;
            EXPECT_EQ(states[k], known ? State::opaque : micromap::unknownOf(opaque)) << k;
        }
    }
}

TEST(Patterns, BlendLeavesTheTentOfOneTexel) {
    auto texture = texture8(8, 8, [](uint32_t x, uint32_t y) { return x == 3 && y == 3 ? 255 : 0; });
    texture.wrapU = texture.wrapV = Wrap::clampToEdge;
    // Lattice points on texel centres.
    const auto triangle = triangleInTexels(texture, {0.5F, 0.5F}, {8.5F, 0.5F}, {0.5F, 8.5F});
    const auto states = bakeOne(triangle, texture, blendTest(), 3);
    for (uint32_t k = 0; k < states.size(); ++k) {
        const auto t = micromap::latticeTriangle(k, 3);
        const bool under = (t.i == 2 || t.i == 3) && (t.j == 2 || t.j == 3);
        EXPECT_EQ(micromap::isKnown(states[k]), !under) << k;
        if (!under) {
            EXPECT_EQ(states[k], State::transparent) << k;
        }
    }
}

TEST(Patterns, DiscIsKnownButForItsRim) {
    const auto distance = [](double x, double y) { return std::hypot(x - 32, y - 32); };
    const auto texture =
        texture8(64, 64, [&](uint32_t x, uint32_t y) { return distance(x + 0.5, y + 0.5) < 20 ? 255 : 0; });
    const auto triangle = triangleInTexels(texture, {0, 0}, {64, 0}, {0, 64});
    const auto other = triangleInTexels(texture, {64, 64}, {0, 64}, {64, 0});
    for (const auto& t : {triangle, other}) {
        const auto baked = bakeAll({&t, 1}, texture, maskTest(), atLevel(7));
        const auto states = statesOf(baked, 0);
        size_t unknown = 0;
        for (uint32_t k = 0; k < states.size(); ++k) {
            double nearest = 1e9;
            double farthest = 0;
            for (const auto c : micromap::corners(micromap::latticeTriangle(k, 7))) {
                const double i = c.i / 128.0;
                const double j = c.j / 128.0;
                const double x = 64 * (t.uv[0].u + i * (t.uv[1].u - t.uv[0].u) + j * (t.uv[2].u - t.uv[0].u));
                const double y = 64 * (t.uv[0].v + i * (t.uv[1].v - t.uv[0].v) + j * (t.uv[2].v - t.uv[0].v));
                nearest = std::min(nearest, distance(x, y));
                farthest = std::max(farthest, distance(x, y));
            }
            if (farthest < 18.5) {
                EXPECT_EQ(states[k], State::opaque) << k;
            }
            if (nearest > 21.5) {
                EXPECT_EQ(states[k], State::transparent) << k;
            }
            unknown += micromap::isKnown(states[k]) ? 0 : 1;
        }
        EXPECT_GT(unknown, 100U);
        EXPECT_LT(unknown, 600U);
        const auto counts = judged(baked, {&t, 1}, texture, maskTest());
        EXPECT_EQ(counts.wrong, 0U);
        EXPECT_EQ(counts.overCautious, 0U);
    }
}

TEST(Patterns, ConstantTexturesOfAnySizeAreSpecial) {
    for (const uint32_t w : {1U, 2U, 3U, 7U, 64U, 65U}) {
        for (const uint32_t h : {1U, 5U}) {
            for (unsigned modes = 0; modes < 27; ++modes) {
                auto opaque = texture8(w, h, [](uint32_t, uint32_t) { return 128; });
                auto clear = texture8(w, h, [](uint32_t, uint32_t) { return 127; });
                for (auto* texture : {&opaque, &clear}) {
                    texture->wrapU = static_cast<Wrap>(modes % 3);
                    texture->wrapV = static_cast<Wrap>(modes / 3 % 3);
                    texture->filter = static_cast<Filter>(modes / 9);
                }
                const auto triangle = triangleOf({-7.3F, 2.1F}, {9, 4}, {0.2F, -55});
                const auto test = maskTest(0.5, 1.0 / 256);
                EXPECT_EQ(bakeAll({&triangle, 1}, opaque, test, atLevel(12)).set.indices[0], -2);
                EXPECT_EQ(bakeAll({&triangle, 1}, clear, test, atLevel(12)).set.indices[0], -1);
            }
        }
    }
}

TEST(Patterns, CutoffsAtAndBeyondTheEnds) {
    auto texture = texture8(4, 4, [](uint32_t x, uint32_t y) { return x == 1 && y == 1 ? 0 : 255; });
    const auto triangle = triangleInTexels(texture, {0, 0}, {4, 0}, {0, 4});
    const auto index = [&](double cutoff) {
        return bakeAll({&triangle, 1}, texture, maskTest(cutoff), atLevel(4)).set.indices[0];
    };
    EXPECT_EQ(index(0), micromap::specialIndex(State::opaque));
    EXPECT_EQ(index(1.5), micromap::specialIndex(State::transparent));
    EXPECT_EQ(index(std::numeric_limits<double>::infinity()), micromap::specialIndex(State::transparent));
    EXPECT_EQ(index(1e-300), 0) << "alpha 0 is below it, all else above";
    // Cutoff 1: opaque on the closed cells between texels of 255 alone.
    const auto states =
        bakeOne(triangleInTexels(texture, {2.5F, 2.5F}, {4.5F, 2.5F}, {2.5F, 4.5F}), texture, maskTest(1), 2);
    for (const State state : states) EXPECT_EQ(state, State::opaque);
}

TEST(Patterns, FactorAndConstantVertexAlphaMultiply) {
    const auto white = texture8(2, 2, [](uint32_t, uint32_t) { return 255; });
    auto triangle = triangleOf({0, 0}, {1, 0}, {0, 1});
    const auto index = [&](double factor, float alpha) {
        auto test = maskTest();
        test.factor = factor;
        triangle.alpha.fill(alpha);
        return bakeAll({&triangle, 1}, white, test, atLevel(3)).set.indices[0];
    };
    EXPECT_EQ(index(1, 1), -2);
    EXPECT_EQ(index(0.5, 1), -2) << "a product equal to the cutoff is opaque";
    EXPECT_EQ(index(0.4999, 1), -1);
    EXPECT_EQ(index(1, 0.5F), -2);
    EXPECT_EQ(index(0.7, 0.7F), -1);
    EXPECT_EQ(index(0, 1), -1);
}

TEST(Patterns, BlendNeedsFullOrNoAlpha) {
    auto triangle = triangleOf({0, 0}, {1, 0}, {0, 1});
    const auto index = [&](unsigned texel, double factor) {
        const auto texture = texture8(2, 2, [&](uint32_t, uint32_t) { return texel; });
        auto test = blendTest();
        test.factor = factor;
        return bakeAll({&triangle, 1}, texture, test, atLevel(3)).set.indices[0];
    };
    EXPECT_EQ(index(255, 1), -2);
    EXPECT_EQ(index(0, 1), -1);
    EXPECT_EQ(index(254, 1), -4) << "nearly opaque is unknown, nearer to opaque";
    EXPECT_EQ(index(1, 1), -3);
    EXPECT_EQ(index(255, 0.75), -4);
    EXPECT_EQ(index(255, 0.25), -3);
    EXPECT_EQ(index(255, 0), -1);
}

TEST(Patterns, BothFiltersMustAgree) {
    auto texture = halves(Wrap::clampToEdge);
    texture.image.texels[3] = texture.image.texels[11] = 64 * 257;  // the contours part: 2.66 and 3
    const auto triangle = strip(texture, 0, 8);
    const auto knownBelow = [&](Filter filter, bool opaque) {
        texture.filter = filter;
        const auto states = bakeOne(triangle, texture, maskTest(), 5);
        double end = opaque ? -1e9 : 1e9;
        for (uint32_t k = 0; k < states.size(); ++k) {
            if (states[k] != micromap::knownOf(opaque)) continue;
            const Extent e = alongFirstEdge(k, 5, 0, 8);
            end = opaque ? std::max(end, e.high) : std::min(end, e.low);
        }
        return end;
    };
    const double linear = knownBelow(Filter::linear, true);
    const double nearest = knownBelow(Filter::nearest, true);
    EXPECT_NE(linear, nearest);
    EXPECT_EQ(knownBelow(Filter::both, true), std::min(linear, nearest));
    const double linearClear = knownBelow(Filter::linear, false);
    EXPECT_EQ(knownBelow(Filter::both, false), std::max(linearClear, knownBelow(Filter::nearest, false)));
}

TEST(Patterns, MipsMustAgree) {
    // Stripes of one texel: at the next level all is 1/2, which is opaque.
    const auto stripes = texture8(8, 1, [](uint32_t x, uint32_t) { return x % 2 == 0 ? 255 : 0; });
    auto test = maskTest();
    const auto triangle = strip(stripes, 0, 8);
    EXPECT_EQ(judged(bakeAll({&triangle, 1}, stripes, test, atLevel(6)), {&triangle, 1}, stripes, test).wrong,
              0U);
    const auto count = [&](State state) {
        const auto states = bakeOne(triangle, stripes, test, 6);
        return std::count(states.begin(), states.end(), state);
    };
    EXPECT_GT(count(State::transparent), 0);
    const auto opaque = count(State::opaque);
    test.mips = 1;
    EXPECT_EQ(count(State::transparent), 0);
    EXPECT_EQ(count(State::opaque), opaque);
    test.mips = 99;  // ends at one texel
    EXPECT_EQ(count(State::opaque), opaque);
}

TEST(Patterns, ThousandPeriods) {
    const auto texture = halves(Wrap::repeat);
    const auto wide = triangleOf({-300, -200}, {700, 100}, {200, 800});
    EXPECT_EQ(bakeAll({&wide, 1}, texture, maskTest(), atLevel(4)).statistics.states.known(), 0U);
    const auto clear = texture8(8, 2, [](uint32_t, uint32_t) { return 3; });
    EXPECT_EQ(bakeAll({&wide, 1}, clear, maskTest(), atLevel(12)).set.indices[0], -1);
    // The same triangle some periods away has the same states.
    const auto here = triangleOf({0.125F, 0.25F}, {1.5F, 0.375F}, {0.75F, 0.875F});
    auto there = here;
    for (mesh::Uv& p : there.uv) p = {p.u + 1000, p.v - 3000};
    EXPECT_EQ(bakeOne(here, texture, maskTest(), 5), bakeOne(there, texture, maskTest(), 5));
}

TEST(Patterns, LinesAndPoints) {
    const auto texture = halves(Wrap::clampToEdge);
    const auto index = [&](mesh::Uv a, mesh::Uv b, mesh::Uv c) {
        const auto t = triangleInTexels(texture, a, b, c);
        return bakeAll({&t, 1}, texture, maskTest(), atLevel(5)).set.indices[0];
    };
    EXPECT_EQ(index({2, 1}, {2, 1}, {2, 1}), -2);
    EXPECT_EQ(index({6, 1}, {6, 1}, {6, 1}), -1);
    EXPECT_EQ(index({0, 1}, {3, 1}, {1, 1}), -2);
    EXPECT_EQ(index({5, 1}, {7, 1.5F}, {6, 1.25F}), -1);
    const auto along = triangleInTexels(texture, {0, 1}, {8, 1}, {0, 1});
    expectStrip(bakeOne(along, texture, maskTest(), 4), 4, 0, 8, 0, [](double x) { return x <= 4; });
}

TEST(Patterns, ATriangleOfOneTexelsHundredthAtLevelTwelve) {
    const auto texture = texture8(8, 8, [](uint32_t x, uint32_t) { return x < 4 ? 255 : 0; });
    const auto inside = triangleInTexels(texture, {2, 2}, {2.01F, 2}, {2, 2.01F});
    EXPECT_EQ(bakeAll({&inside, 1}, texture, maskTest(), atLevel(12)).set.indices[0], -2);
}

TEST(Patterns, NumbersOutOfReachAreUnknownOpaqueAndCounted) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const auto texture = halves(Wrap::repeat);
    std::vector<mesh::UvTriangle> triangles;
    for (const float bad : {nan, infinity, -infinity, 3e38F, -1e9F}) {
        for (size_t k = 0; k < 3; ++k) {
            triangles.push_back(triangleOf({0, 0}, {0.1F, 0}, {0, 0.1F}));
            (k % 2 == 0 ? triangles.back().uv[k].u : triangles.back().uv[k].v) = bad;
        }
    }
    const auto bad = triangles.size();
    triangles.push_back(triangleOf({0.1F, 0}, {0.2F, 0}, {0.1F, 0.1F}));
    for (const auto format : {micromap::Format::fourState, micromap::Format::twoState}) {
        Settings settings = atLevel(4);
        settings.format = format;
        const Baked baked = bakeAll(triangles, texture, maskTest(), settings);
        const int32_t expected = format == micromap::Format::fourState ? -4 : -2;
        for (size_t t = 0; t < bad; ++t) EXPECT_EQ(baked.set.indices[t], expected) << t;
        EXPECT_EQ(baked.set.indices[bad], -2);
        EXPECT_EQ(baked.statistics.nonFiniteTriangles, bad);
    }
}

TEST(Patterns, VaryingVertexAlphaIsBounded) {
    const auto white = texture8(2, 2, [](uint32_t, uint32_t) { return 255; });
    auto triangle = triangleOf({0, 0}, {1, 0}, {0, 1});
    triangle.alpha = {1, 0, 0};  // 1/2 where i + j is half of the way
    const auto states = bakeOne(triangle, white, maskTest(), 4);
    for (uint32_t k = 0; k < states.size(); ++k) {
        const auto t = micromap::latticeTriangle(k, 4);
        const uint32_t low = t.i + t.j + (t.flipped ? 1 : 0);
        const bool opaque = low + 1 < 8;
        const bool transparent = low > 8;
        EXPECT_EQ(micromap::isKnown(states[k]), opaque || transparent) << k;
        EXPECT_EQ(micromap::isOpaqueSide(states[k]), low < 8) << k;
    }
    triangle.alpha = {1, std::numeric_limits<float>::quiet_NaN(), 0};
    EXPECT_EQ(bakeAll({&triangle, 1}, white, maskTest(), atLevel(3)).set.indices[0], -4);
}

}  // namespace
}  // namespace filigree::bake::tests
