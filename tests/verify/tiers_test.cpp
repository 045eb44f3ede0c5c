// What the fast tier says for certain, the exact tier says as well.
#include "filigree/micromap/curve.h"

#include "scenes.h"
#include "verify/exact.h"
#include "verify/judge.h"

#include <cmath>

#include <gtest/gtest.h>

namespace filigree::verify {
namespace {

using tests::Random;

// Shapes that are hard on rounding: nearly lines, on texel lines, far from the origin, one float step off.
mesh::UvTriangle hardTriangle(Random& random) {
    mesh::UvTriangle triangle = random.triangle(random.below(2) == 0 ? 0.25F : 4.0F);
    auto& uv = triangle.uv;
    if (random.below(3) == 0) {
        for (mesh::Uv& p : uv) p = {std::round(p.u * 8) / 8, std::round(p.v * 8) / 8};
    }
    if (random.below(3) == 0) uv[1] = {(uv[0].u + uv[2].u) / 2, (uv[0].v + uv[2].v) / 2};
    if (random.below(4) == 0) uv[1].u = uv[0].u;
    if (random.below(4) == 0) uv[random.below(3)].v = uv[random.below(3)].v;
    if (random.below(4) == 0) uv[0].u = std::nextafter(uv[0].u, random.below(2) == 0 ? 9.0F : -9.0F);
    if (random.below(6) == 0) {
        for (mesh::Uv& p : uv) p.u += 5000;
    }
    return triangle;
}

image::AlphaTest hardTest(Random& random) {
    static constexpr double cutoffs[] = {0, 0.2, 0.25, 0.5, 0.6, 1, 1.5};
    static constexpr double guards[] = {0, 0, 0x1p-8, 0.25, 0.5, 1e-9, 1.0 / 3};
    image::AlphaTest test = tests::maskTest(cutoffs[random.below(7)], guards[random.below(7)]);
    if (random.below(3) == 0) test.mode = image::AlphaMode::blend;
    if (random.below(4) == 0) test.factor = random.between(0, 1);
    return test;
}

struct Outcome {
    unsigned decided = 0;
    unsigned undecided = 0;
};

// Judges the shape on both tiers and expects that they agree.
void compare(Filtering filtering, const Layer& layer, const mesh::UvTriangle& triangle, unsigned level,
             uint32_t m, const image::AlphaTest& test, Outcome& outcome) {
    const auto place = micromap::latticeTriangle(m, level);
    const double n = 1 << level;
    RoundedShape shape;
    shape.guard = test.guard;
    double size = test.guard;
    for (size_t k = 0; k < 3; ++k) {
        const auto corner = micromap::corners(place)[k];
        const std::array<double, 3> weights{n - corner.i - corner.j, double(corner.i), double(corner.j)};
        for (size_t w = 0; w < 3; ++w) {
            shape.corners[k].x += weights[w] * double{triangle.uv[w].u} * layer.width() / n;
            shape.corners[k].y += weights[w] * double{triangle.uv[w].v} * layer.height() / n;
            size = std::max({size, std::abs(double{triangle.uv[w].u}) * layer.width(),
                             std::abs(double{triangle.uv[w].v}) * layer.height()});
        }
        const double offset = filtering == Filtering::linear ? 0.5 : 0;
        shape.corners[k].x -= offset;
        shape.corners[k].y -= offset;
    }
    shape.margin = marginFor(size);
    const Limits limits = makeLimits(test, 1);
    const Verdict rounded = judgeRounded(layer, filtering, shape, limits);
    const Verdict exact = judgeExactly(layer, filtering, triangle, level, place, test.guard, limits);
    ++(rounded.decided() ? outcome.decided : outcome.undecided);
    EXPECT_TRUE(!rounded.decided() || truthOf(rounded) == truthOf(exact));
    EXPECT_TRUE(!rounded.notOpaque || exact.notOpaque);
    EXPECT_TRUE(!rounded.notTransparent || exact.notTransparent);
    EXPECT_TRUE(rounded.maybeNotOpaque || !exact.maybeNotOpaque);
    EXPECT_TRUE(rounded.maybeNotTransparent || !exact.maybeNotTransparent);
}

TEST(Tiers, Agree) {
    Random random(11);
    Outcome outcome;
    for (unsigned round = 0; round < 20000 && !testing::Test::HasFailure(); ++round) {
        const image::AlphaTexture texture = random.texture();
        const Layer layer(texture.image, texture.wrapU, texture.wrapV);
        const mesh::UvTriangle triangle = hardTriangle(random);
        const image::AlphaTest test = hardTest(random);
        const unsigned level = random.below(4);
        const uint32_t m = random.below(1U << (2 * level));
        for (const Filtering filtering : {Filtering::linear, Filtering::nearest}) {
            compare(filtering, layer, triangle, level, m, test, outcome);
        }
        EXPECT_FALSE(testing::Test::HasFailure()) << "round " << round;
    }
    EXPECT_GT(outcome.decided, 30000U);
    EXPECT_GT(outcome.undecided, 100U) << "the exact tier has had no work";
}

TEST(Tiers, ThresholdsAreExact) {
    Random random(12);
    for (unsigned round = 0; round < 1000; ++round) {
        image::AlphaTest test = tests::maskTest(random.between(0, 1));
        test.factor = random.between(0, 1);
        const float alpha = random.between(0, 1);
        const Limits limits = makeLimits(test, alpha);
        const auto quotient =
            static_cast<long double>(test.cutoff) * 65535 / (static_cast<long double>(test.factor) * alpha);
        if (quotient > 65535) {
            EXPECT_EQ(limits.low.texel, 65536U);
            continue;
        }
        EXPECT_EQ(limits.low.texel, static_cast<uint32_t>(std::ceil(quotient)));
        EXPECT_NEAR(limits.low.value, static_cast<double>(quotient), limits.low.slack);
        EXPECT_TRUE(limits.low == limits.high) << "random texels do not sit on the cutoff";
    }
}

TEST(Tiers, BlocksReadWhatSingleTexelsSay) {
    Random random(13);
    for (unsigned round = 0; round < 2000; ++round) {
        const image::AlphaTexture texture = random.texture();
        const Layer layer(texture.image, texture.wrapU, texture.wrapV);
        const auto start = [&] { return static_cast<int64_t>(random.below(60)) - 30; };
        TexelBlock block{start(), 0, start(), 0};
        block.x1 = block.x0 + random.below(30);
        block.y1 = block.y0 + random.below(30);
        TexelRange expected;
        for (int64_t y = block.y0; y <= block.y1; ++y) {
            for (int64_t x = block.x0; x <= block.x1; ++x) expected.add(layer.texel(x, y));
        }
        TexelRange found;
        layer.addBlock(block, found, [](const TexelRange&) { return false; });
        EXPECT_EQ(found.lo, expected.lo);
        EXPECT_EQ(found.hi, expected.hi);
    }
}

}  // namespace
}  // namespace filigree::verify
