// Dense samples never contradict a truth, and find both sides of what is called mixed.
#include "filigree/micromap/curve.h"

#include "scenes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace filigree::verify {
namespace {

using tests::Random;

int64_t wrap(int64_t at, int64_t size, image::Wrap mode) {
    if (mode == image::Wrap::clampToEdge) return std::clamp<int64_t>(at, 0, size - 1);
    const auto copy = static_cast<int64_t>(std::floor(static_cast<double>(at) / static_cast<double>(size)));
    const int64_t place = at - copy * size;
    return mode == image::Wrap::mirroredRepeat && copy % 2 != 0 ? size - 1 - place : place;
}

double texel(const image::AlphaTexture& t, int64_t x, int64_t y) {
    return t.image.at(static_cast<uint32_t>(wrap(x, t.image.width, t.wrapU)),
                      static_cast<uint32_t>(wrap(y, t.image.height, t.wrapV))) /
           65535.0;
}

double linearAt(const image::AlphaTexture& t, double x, double y) {
    const double left = std::floor(x - 0.5);
    const double low = std::floor(y - 0.5);
    double sum = 0;
    for (int dy = 0; dy < 2; ++dy) {
        for (int dx = 0; dx < 2; ++dx) {
            const double weight = (1 - std::abs(x - 0.5 - left - dx)) * (1 - std::abs(y - 0.5 - low - dy));
            sum += weight * texel(t, static_cast<int64_t>(left) + dx, static_cast<int64_t>(low) + dy);
        }
    }
    return sum;
}

double nearestAt(const image::AlphaTexture& t, double x, double y) {
    return texel(t, static_cast<int64_t>(std::floor(x)), static_cast<int64_t>(std::floor(y)));
}

struct Extremes {
    double lo = 1e9;
    double hi = -1e9;
    void add(double value) {
        lo = std::min(lo, value);
        hi = std::max(hi, value);
    }
};

// The values at points of the micro-triangle, each moved within the guard's square.
Extremes sampled(const mesh::UvTriangle& triangle, unsigned level, uint32_t m,
                 const image::AlphaTexture& texture, const image::AlphaTest& test) {
    constexpr int steps = 12;
    const auto corners = micromap::corners(micromap::latticeTriangle(m, level));
    const double n = 1 << level;
    Extremes result;
    for (int a = 0; a <= steps; ++a) {
        for (int b = 0; a + b <= steps; ++b) {
            const std::array<double, 3> inner{double(steps - a - b) / steps, double(a) / steps,
                                              double(b) / steps};
            double i = 0, j = 0, u = 0, v = 0, alpha = 0;
            for (size_t k = 0; k < 3; ++k) i += inner[k] * corners[k].i / n, j += inner[k] * corners[k].j / n;
            const std::array<double, 3> weights{1 - i - j, i, j};
            for (size_t k = 0; k < 3; ++k) {
                u += weights[k] * double{triangle.uv[k].u};
                v += weights[k] * double{triangle.uv[k].v};
                alpha += weights[k] * double{triangle.alpha[k]};
            }
            for (int gy = -1; gy <= (test.guard > 0 ? 1 : -1); ++gy) {
                for (int gx = -1; gx <= (test.guard > 0 ? 1 : -1); ++gx) {
                    const double x = u * texture.image.width + gx * test.guard;
                    const double y = v * texture.image.height + gy * test.guard;
                    const double value = texture.filter == image::Filter::nearest ? nearestAt(texture, x, y)
                                                                                  : linearAt(texture, x, y);
                    result.add(value * alpha * test.factor);
                }
            }
        }
    }
    return result;
}

struct Tally {
    unsigned contradictions = 0;
    unsigned known = 0;
    unsigned mixed = 0;
    unsigned mixedUnseen = 0;
    unsigned uncertain = 0;
};

void tally(Tally& tally, Truth truth, const Extremes& seen, const image::AlphaTest& test) {
    const double rounding = 1e-9;
    const bool blend = test.mode == image::AlphaMode::blend;
    const bool notOpaque = seen.lo < (blend ? 1 : test.cutoff) - rounding;
    const bool notTransparent = seen.hi > (blend ? 0 : test.cutoff) + rounding;
    if (truth == Truth::opaque || truth == Truth::transparent) {
        ++tally.known;
        tally.contradictions += truth == Truth::opaque ? notOpaque : notTransparent;
    } else if (truth == Truth::mixed) {
        ++tally.mixed;
        tally.mixedUnseen += !(notOpaque && notTransparent);
    } else {
        ++tally.uncertain;
    }
}

Tally tallyRandom(
    uint32_t seed,
    const std::function<void(Random&, image::AlphaTexture&, image::AlphaTest&, mesh::UvTriangle&)>& change) {
    Random random(seed);
    Tally result;
    for (unsigned round = 0; round < 400; ++round) {
        image::AlphaTexture texture = random.texture();
        image::AlphaTest test = tests::maskTest(random.between(0.05F, 0.95F));
        mesh::UvTriangle triangle = random.triangle(random.below(2) == 0 ? 0.5F : 2.0F);
        change(random, texture, test, triangle);
        const Judge judge(texture, test);
        const unsigned level = random.below(3);
        for (uint32_t m = 0; m < 1U << (2 * level); ++m) {
            tally(result, judge.truth(triangle, level, m), sampled(triangle, level, m, texture, test), test);
        }
    }
    return result;
}

void expectSound(const Tally& result, double mostUnseen) {
    EXPECT_EQ(result.contradictions, 0U);
    EXPECT_GT(result.known, 100U);
    EXPECT_GT(result.mixed, 100U);
    EXPECT_LT(result.mixedUnseen, mostUnseen * result.mixed);
    EXPECT_EQ(result.uncertain, 0U);
}

TEST(Sampling, AgreesOnLinearFiltering) {
    expectSound(tallyRandom(1, [](auto&, auto&, auto&, auto&) {}), 0.02);
}

TEST(Sampling, AgreesWithAGuard) {
    expectSound(tallyRandom(2, [](Random& random, auto&, auto& test,
                                  auto&) { test.guard = random.between(0, 0.7F); }),
                0.02);
}

TEST(Sampling, AgreesOnNearestFiltering) {
    expectSound(tallyRandom(3,
                            [](Random& random, auto& texture, auto& test, auto&) {
                                texture.filter = image::Filter::nearest;
                                if (random.below(2) == 0) test.guard = random.between(0, 0.7F);
                            }),
                0.1);
}

TEST(Sampling, AgreesOnBlendAndFactors) {
    expectSound(tallyRandom(4,
                            [](Random& random, auto&, auto& test, auto&) {
                                if (random.below(2) == 0) test.mode = image::AlphaMode::blend;
                                if (random.below(2) == 0) test.factor = random.between(0.5F, 1);
                            }),
                0.2);
}

TEST(Sampling, AgreesOnLinesAndPoints) {
    expectSound(tallyRandom(5,
                            [](Random& random, auto&, auto& test, auto& triangle) {
                                triangle.uv[2] = triangle.uv[random.below(2)];
                                if (random.below(3) == 0) triangle.uv[0] = triangle.uv[2];
                                if (random.below(2) == 0) test.guard = random.between(0, 0.7F);
                            }),
                0.02);
}

TEST(Sampling, AgreesWhereEdgesLieOnTexelLines) {
    // Halves of texels and a cutoff that 0/255 textures meet half way: nearly all shapes touch the contour.
    const auto snap = [](Random& random, image::AlphaTexture& texture, image::AlphaTest& test,
                         mesh::UvTriangle& triangle) {
        texture.image =
            tests::texture8(4, 8, [&](uint32_t, uint32_t) { return random.below(2) * 255; }).image;
        for (mesh::Uv& uv : triangle.uv) uv = {std::round(uv.u * 8) / 8, std::round(uv.v * 16) / 16};
        test.cutoff = 0.5;
        if (random.below(2) == 0) test.guard = 0.25;
        if (random.below(4) == 0) texture.filter = image::Filter::nearest;
    };
    const Tally result = tallyRandom(6, snap);
    EXPECT_EQ(result.contradictions, 0U);
    EXPECT_GT(result.known, 100U);
    EXPECT_EQ(result.uncertain, 0U);
}

TEST(Sampling, AgreesOnVaryingVertexAlpha) {
    const Tally result = tallyRandom(7, [](Random& random, auto&, auto& test, auto& triangle) {
        for (float& alpha : triangle.alpha) alpha = random.between(0, 1);
        test.cutoff *= 0.5;
        if (random.below(2) == 0) test.guard = random.between(0, 0.1F);
    });
    EXPECT_EQ(result.contradictions, 0U);
    EXPECT_GT(result.known, 100U);
    EXPECT_LT(result.mixedUnseen, 0.02 * result.mixed);
    EXPECT_LT(result.uncertain, 0.02 * (result.known + result.mixed));
}

}  // namespace
}  // namespace filigree::verify
