// Squares against the judge, against samples and against patterns whose answers are known.
#include "filigree/quadmap/squares.h"

#include "filigree/micromap/curve.h"
#include "filigree/verify/verify.h"

#include "image/textures.h"

#include <bit>
#include <limits>

#include <gtest/gtest.h>

namespace filigree::quadmap {
namespace {

using image::tests::Random;

image::AlphaTest maskTest(double cutoff = 0.5, double guard = 0) {
    image::AlphaTest test;
    test.cutoff = cutoff;
    test.guard = guard;
    return test;
}

// A clamped texture of 8-bit values from value(x, y).
template <class Value>
image::AlphaTexture textureOf(uint32_t width, uint32_t height, Value value) {
    std::vector<uint8_t> texels;
    for (uint32_t y = 0; y < height; ++y) {
        for (uint32_t x = 0; x < width; ++x) texels.push_back(static_cast<uint8_t>(value(x, y)));
    }
    image::AlphaTexture texture;
    texture.image = image::alphaImageFrom8Bit(width, height, texels);
    texture.wrapU = texture.wrapV = image::Wrap::clampToEdge;
    return texture;
}

HalfTriangle triangleOf(mesh::Uv a, mesh::Uv b, mesh::Uv c) {
    HalfTriangle triangle;
    triangle.uv = {a, b, c};
    return triangle;
}

Region regionOf(verify::Truth truth) {
    return truth == verify::Truth::opaque        ? Region::opaque
           : truth == verify::Truth::transparent ? Region::transparent
                                                 : Region::mixed;
}

// What the judge says of the half's part of region (i, j) in the half's own lattice.
Region judged(const verify::Judge& judge, const HalfTriangle& triangle, unsigned i, unsigned j,
              unsigned side) {
    const auto level = static_cast<unsigned>(std::countr_zero(side));
    const auto ask = [&](bool flipped) {
        return regionOf(judge.truth(triangle, level, micromap::curveIndex({i, j, flipped}, level)));
    };
    const Region region = ask(false);
    if (i + j + 1 == side) return region;
    return ask(true) == region ? region : Region::mixed;
}

Region merged(Region a, Region b) {
    return a == b ? a : Region::mixed;
}

Square judgedPair(const verify::Judge& judge, const HalfTriangle& first, const HalfTriangle& second,
                  unsigned side) {
    Square square(side);
    for (unsigned y = 0; y < side; ++y) {
        for (unsigned x = 0; x < side; ++x) {
            const unsigned i = side - 1 - x;
            const unsigned j = side - 1 - y;
            if (x + y + 1 < side) {
                square.at(x, y) = judged(judge, first, x, y, side);
            } else if (x + y + 1 > side) {
                square.at(x, y) = judged(judge, second, i, j, side);
            } else {
                square.at(x, y) = merged(judged(judge, first, x, y, side), judged(judge, second, i, j, side));
            }
        }
    }
    return square;
}

mesh::Uv randomUv(Random& random, double reach) {
    const double grid = random.below(2) == 0 ? 64 : 1024;  // on texels, texel centres or off them
    return {static_cast<float>(std::round(random.between(-reach, reach) * grid) / grid),
            static_cast<float>(std::round(random.between(-reach, reach) * grid) / grid)};
}

TEST(Squares, ArePreciselyWhatTheJudgeSays) {
    Random random(11);
    for (int round = 0; round < 60; ++round) {
        image::AlphaTexture texture = random.texture(1 + random.below(24), 1 + random.below(24));
        texture.filter = static_cast<image::Filter>(random.below(3));
        image::AlphaTest test = maskTest(random.below(3) == 0 ? 0.25 : 0.5, random.below(2) / 256.0);
        test.mips = random.below(3);
        if (random.below(5) == 0) test.mode = image::AlphaMode::blend;
        const SquareMaker maker(texture, test);
        const verify::Judge judge(texture, test);
        const mesh::Uv a = randomUv(random, 1.5);
        const mesh::Uv b = randomUv(random, 1.5);
        const mesh::Uv c = randomUv(random, 1.5);
        const HalfTriangle first = triangleOf(a, b, c);
        const HalfTriangle second = triangleOf(randomUv(random, 1.5), c, b);
        const Square square = maker.ofPair(first, second, 16);
        const Square truth = judgedPair(judge, first, second, 16);
        EXPECT_TRUE(isConservative(truth, square)) << round;
        EXPECT_LE(substitutions(truth, square), 1u) << round;  // what rounding cannot tell
    }
}

// The vertex alpha of a half's lattice, at (i, j) in 0..1.
double vertexAlpha(const HalfTriangle& t, double i, double j) {
    return t.alpha[0] + i * (t.alpha[1] - t.alpha[0]) + j * (t.alpha[2] - t.alpha[0]);
}

mesh::Uv at(const HalfTriangle& t, double i, double j) {
    const auto mix = [&](double a, double b, double c) { return a + i * (b - a) + j * (c - a); };
    return {static_cast<float>(mix(t.uv[0].u, t.uv[1].u, t.uv[2].u)),
            static_cast<float>(mix(t.uv[0].v, t.uv[1].v, t.uv[2].v))};
}

TEST(Squares, AreConservativeWhereVertexAlphaVaries) {
    Random random(5);
    size_t known = 0;
    for (int round = 0; round < 40; ++round) {
        image::AlphaTexture texture = random.texture(16, 16);
        const SquareMaker maker(texture, maskTest());
        HalfTriangle triangle = triangleOf(randomUv(random, 1), randomUv(random, 1), randomUv(random, 1));
        for (float& alpha : triangle.alpha) alpha = static_cast<float>(random.between(0, 1));
        const unsigned side = 16;
        const Square square = maker.ofSingle(triangle, side);
        for (int sample = 0; sample < 2000; ++sample) {
            const double i = random.between(0, 1);
            const double j = random.between(0, 1 - i);
            const Region region = square.at(regionAlong(float(i), side), regionAlong(float(j), side));
            if (!isKnown(region)) continue;
            ++known;
            const mesh::Uv uv = at(triangle, i, j);
            const double alpha = image::sampleBilinear(texture, double{uv.u} * 16, double{uv.v} * 16) *
                                 vertexAlpha(triangle, i, j);
            if (std::abs(alpha - 0.5) < 1e-5) continue;
            ASSERT_EQ(region == Region::opaque, alpha >= 0.5) << round << " at " << i << ", " << j;
        }
    }
    EXPECT_GT(known, 1000u);
}

TEST(Squares, HalfPlaneIsExact) {
    // Alpha meets one half at x = 32, which is opaque.
    const auto texture = textureOf(64, 48, [](uint32_t x, uint32_t) { return x < 32 ? 255 : 0; });
    image::AlphaTest test = maskTest(128.0 / 255);  // met a little before x = 32
    const Square square = SquareMaker(texture, test).ofTexture(16);
    const Square touching = SquareMaker(texture, maskTest(0.5)).ofTexture(16);
    for (unsigned y = 0; y < 16; ++y) {
        for (unsigned x = 0; x < 16; ++x) {
            EXPECT_EQ(square.at(x, y), x < 7 ? Region::opaque : x > 7 ? Region::transparent : Region::mixed);
            EXPECT_EQ(touching.at(x, y), x < 8   ? Region::opaque
                                         : x > 8 ? Region::transparent
                                                 : Region::mixed);
        }
    }
}

TEST(Squares, AllWrapsReadBeyondTheBorder) {
    // One opaque column at the left: repeat brings it to the right border, clamp and mirror do not.
    for (const image::Wrap wrap : image::tests::wraps) {
        auto texture = textureOf(16, 16, [](uint32_t x, uint32_t) { return x == 0 ? 255 : 0; });
        texture.wrapU = wrap;
        const Square square = SquareMaker(texture, maskTest()).ofTexture(16);
        EXPECT_EQ(square.at(15, 3), wrap == image::Wrap::repeat ? Region::mixed : Region::transparent);
        EXPECT_EQ(square.at(0, 3), Region::opaque);
    }
}

TEST(Squares, CropsArePairsOfTheirTriangles) {
    Random random(3);
    for (int round = 0; round < 20; ++round) {
        const image::AlphaTexture texture = random.texture(32, 64);
        const SquareMaker maker(texture, maskTest());
        const Crop crop{random.below(8), random.below(8), 9 + random.below(24), 9 + random.below(56)};
        const auto uv = [](uint32_t x, uint32_t y) {
            return mesh::Uv{static_cast<float>(x) / 32, static_cast<float>(y) / 64};
        };
        const mesh::Uv corners[] = {uv(crop.x0, crop.y0), uv(crop.x1, crop.y0), uv(crop.x0, crop.y1),
                                    uv(crop.x1, crop.y1)};
        EXPECT_EQ(maker.ofCrop(crop, 32), maker.ofPair(triangleOf(corners[0], corners[1], corners[2]),
                                                       triangleOf(corners[3], corners[2], corners[1]), 32));
    }
}

TEST(Squares, HalvedIsTheSquareOfHalfTheSide) {
    Random random(9);
    for (int round = 0; round < 20; ++round) {
        const image::AlphaTexture texture = random.texture(1 + random.below(64), 1 + random.below(64));
        const SquareMaker maker(texture, maskTest(0.5, 1.0 / 256));
        const HalfTriangle triangle =
            triangleOf(randomUv(random, 1), randomUv(random, 1), randomUv(random, 1));
        for (unsigned side = 64; side > 1; side /= 2) {
            EXPECT_EQ(halved(maker.ofTexture(side)), maker.ofTexture(side / 2));
            EXPECT_EQ(halved(maker.ofSingle(triangle, side)), maker.ofSingle(triangle, side / 2));
        }
    }
}

TEST(Squares, SingleTrianglesLeaveTheOtherHalfFree) {
    const auto texture = textureOf(8, 8, [](uint32_t, uint32_t) { return 255; });
    const Square square = SquareMaker(texture, maskTest()).ofSingle(triangleOf({0, 0}, {1, 0}, {0, 1}), 8);
    for (unsigned y = 0; y < 8; ++y) {
        for (unsigned x = 0; x < 8; ++x)
            EXPECT_EQ(square.at(x, y), x + y < 8 ? Region::opaque : Region::free);
    }
    EXPECT_EQ(savings(square), 1);
}

TEST(Squares, DegenerateTrianglesFollowTheirLine) {
    const auto texture = textureOf(16, 16, [](uint32_t x, uint32_t) { return x < 8 ? 255 : 0; });
    const SquareMaker maker(texture, maskTest());
    const Square point = maker.ofSingle(triangleOf({0.25F, 0.5F}, {0.25F, 0.5F}, {0.25F, 0.5F}), 8);
    EXPECT_EQ(savings(point), 1);
    const Square line = maker.ofSingle(triangleOf({0, 0.5F}, {1, 0.5F}, {0, 0.5F}), 8);
    EXPECT_EQ(line.at(0, 0), Region::opaque);
    EXPECT_EQ(line.at(7, 0), Region::transparent);
}

TEST(Squares, OutOfReachIsMixed) {
    const auto texture = textureOf(4, 4, [](uint32_t, uint32_t) { return 255; });
    const SquareMaker maker(texture, maskTest());
    const HalfTriangle good = triangleOf({0, 0}, {1, 0}, {0, 1});
    for (const float wrong :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1e30F}) {
        HalfTriangle bad = good;
        bad.uv[1].v = wrong;
        const Square square = maker.ofPair(good, bad, 8);
        EXPECT_EQ(square.at(0, 0), Region::opaque);
        EXPECT_EQ(square.at(7, 0), Region::mixed);
        EXPECT_EQ(square.at(7, 7), Region::mixed);
        bad = good;
        bad.alpha[2] = wrong;
        if (std::isfinite(wrong)) continue;
        EXPECT_EQ(savings(maker.ofSingle(bad, 8)), 0);
    }
}

TEST(Squares, VisibleCrop) {
    const auto texture =
        textureOf(9, 7, [](uint32_t x, uint32_t y) { return x >= 2 && x < 5 && y >= 3 && y < 6 ? 1 : 0; });
    EXPECT_EQ(visibleCrop(texture.image), (Crop{2, 3, 5, 6}));
    const auto empty = textureOf(9, 7, [](uint32_t, uint32_t) { return 0; });
    EXPECT_EQ(visibleCrop(empty.image), std::nullopt);
}

}  // namespace
}  // namespace filigree::quadmap
