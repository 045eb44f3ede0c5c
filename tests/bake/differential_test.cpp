// The baker against the independent judge on random small scenes: nothing known may be wrong, and little that
// is uniform may be unknown.
#include "baking.h"

#include <cmath>

namespace filigree::bake::tests {
namespace {

// Counts over many rounds.
struct Totals {
    uint64_t microTriangles = 0;
    uint64_t overCautious = 0;

    void add(const verify::DeepCounts& counts) {
        microTriangles += counts.microTriangles;
        overCautious += counts.overCautious;
    }
    [[nodiscard]] double share() const {
        return static_cast<double>(overCautious) / static_cast<double>(microTriangles);
    }
};

// Bakes in both formats and holds the result to the judge.
void check(std::span<const mesh::UvTriangle> triangles, const image::AlphaTexture& texture,
           const image::AlphaTest& test, unsigned level, Totals& totals) {
    Settings settings = atLevel(level);
    const Baked four = bakeAll(triangles, texture, test, settings);
    const verify::DeepCounts counts = judged(four, triangles, texture, test);
    EXPECT_EQ(counts.wrong, 0u) << describe(texture, test) << describe(counts, triangles);
    totals.add(counts);
    settings.format = micromap::Format::twoState;
    const Baked two = bakeAll(triangles, texture, test, settings);
    const verify::DeepCounts twoCounts = judged(two, triangles, texture, test);
    EXPECT_EQ(twoCounts.wrong, 0u) << describe(texture, test) << describe(twoCounts, triangles);
}

image::AlphaTest randomTest(Random& random) {
    constexpr double cutoffs[] = {0, 0.2, 0.25, 0.5, 0.6, 1, 1.5};
    image::AlphaTest test;
    test.cutoff = random.below(2) != 0 ? cutoffs[random.below(7)] : double{random.between(0, 1)};
    test.guard = 0;
    if (random.below(3) == 0) test.mode = image::AlphaMode::blend;
    if (random.below(4) == 0) test.factor = random.between(0, 1);
    if (random.below(3) == 0) test.mips = random.below(4);
    return test;
}

// Triangles of a few texels or a few periods; some on the texels' own lattice, some degenerate.
std::vector<mesh::UvTriangle> randomTriangles(Random& random, const image::AlphaTexture& texture) {
    std::vector<mesh::UvTriangle> triangles;
    const auto w = static_cast<float>(texture.image.width);
    const auto h = static_cast<float>(texture.image.height);
    for (int k = 0; k < 4; ++k) {
        mesh::UvTriangle t = random.triangle(random.below(2) != 0 ? 0.5F : 3.0F);
        if (random.below(3) == 0) {
            for (mesh::Uv& p : t.uv)
                p = {std::round(p.u * w * 2) / (2 * w), std::round(p.v * h * 2) / (2 * h)};
        }
        if (random.below(6) == 0) t.uv[1] = t.uv[0];
        if (random.below(12) == 0) t.uv[2] = t.uv[0];
        triangles.push_back(t);
    }
    return triangles;
}

TEST(Differential, RandomScenesWithoutGuard) {
    Random random(1);
    Totals totals;
    for (int round = 0; round < 400; ++round) {
        image::AlphaTexture texture = random.texture();
        texture.filter = static_cast<image::Filter>(random.below(3));
        const image::AlphaTest test = randomTest(random);
        check(randomTriangles(random, texture), texture, test, random.below(6), totals);
    }
    EXPECT_LE(totals.share(), 0.003);
    RecordProperty("over_cautious_per_million", std::to_string(totals.share() * 1e6));
}

TEST(Differential, RandomScenesWithGuard) {
    constexpr double guards[] = {1.0 / 256, 0.25, 1, 3.5};
    Random random(2);
    Totals totals;
    for (int round = 0; round < 250; ++round) {
        image::AlphaTexture texture = random.texture();
        texture.filter = static_cast<image::Filter>(random.below(3));
        image::AlphaTest test = randomTest(random);
        test.guard = guards[random.below(4)];
        check(randomTriangles(random, texture), texture, test, random.below(5), totals);
    }
    EXPECT_LE(totals.share(), 0.003);
}

TEST(Differential, RandomConstantVertexAlpha) {
    Random random(3);
    Totals totals;
    for (int round = 0; round < 150; ++round) {
        image::AlphaTexture texture = random.texture();
        const image::AlphaTest test = randomTest(random);
        std::vector<mesh::UvTriangle> triangles = randomTriangles(random, texture);
        for (mesh::UvTriangle& t : triangles) t.alpha.fill(random.between(0, 1));
        check(triangles, texture, test, random.below(5), totals);
    }
    EXPECT_LE(totals.share(), 0.003);
}

TEST(Differential, RandomVaryingVertexAlpha) {
    Random random(4);
    Totals totals;
    for (int round = 0; round < 150; ++round) {
        image::AlphaTexture texture = random.texture();
        texture.filter = static_cast<image::Filter>(random.below(3));
        image::AlphaTest test = randomTest(random);
        if (random.below(2) != 0) test.guard = 1.0 / 256;
        std::vector<mesh::UvTriangle> triangles = randomTriangles(random, texture);
        for (mesh::UvTriangle& t : triangles) {
            for (float& a : t.alpha) a = random.below(4) == 0 ? 1 : random.between(0, 1);
        }
        check(triangles, texture, test, random.below(4), totals);
    }
    EXPECT_LE(totals.share(), 0.05);
}

// Triangles much smaller than a texel, at levels that no shader could use.
TEST(Differential, TinyTriangles) {
    Random random(5);
    Totals totals;
    for (int round = 0; round < 150; ++round) {
        const image::AlphaTexture texture = random.texture();
        const image::AlphaTest test = randomTest(random);
        const float size = std::ldexp(1.0F, -static_cast<int>(2 + random.below(18)));
        const std::vector triangles{random.triangle(size), random.triangle(size)};
        check(triangles, texture, test, random.below(5), totals);
    }
    EXPECT_LE(totals.share(), 0.003);
}

// Slivers: one corner lies on the opposite edge but for some bits.
TEST(Differential, Slivers) {
    Random random(6);
    Totals totals;
    for (int round = 0; round < 200; ++round) {
        image::AlphaTexture texture = random.texture();
        texture.filter = static_cast<image::Filter>(random.below(3));
        image::AlphaTest test = randomTest(random);
        if (random.below(2) != 0) test.guard = 1.0 / 256;
        mesh::UvTriangle t = random.triangle(random.below(2) != 0 ? 0.5F : 3.0F);
        const float along = random.between(-0.5F, 1.5F);
        const float off = std::ldexp(1.0F, -static_cast<int>(random.below(26)));
        t.uv[2] = {t.uv[0].u + along * (t.uv[1].u - t.uv[0].u) + off * random.between(-1, 1),
                   t.uv[0].v + along * (t.uv[1].v - t.uv[0].v)};
        check({&t, 1}, texture, test, random.below(6), totals);
    }
    EXPECT_LE(totals.share(), 0.003);
}

// Far from the origin, where float coordinates are coarse.
TEST(Differential, FarTriangles) {
    Random random(7);
    Totals totals;
    for (int round = 0; round < 150; ++round) {
        const image::AlphaTexture texture = random.texture();
        const image::AlphaTest test = randomTest(random);
        const float far = std::ldexp(1.0F, static_cast<int>(random.below(13)));
        mesh::UvTriangle t = random.triangle(3);
        for (mesh::Uv& p : t.uv) p = {p.u + far, p.v - far * static_cast<float>(random.below(2))};
        check({&t, 1}, texture, test, random.below(5), totals);
    }
    EXPECT_LE(totals.share(), 0.003);
}

// Long textures: one axis of very many texels.
TEST(Differential, LongTextures) {
    Random random(8);
    Totals totals;
    for (int round = 0; round < 24; ++round) {
        const bool wide = random.below(2) != 0;
        const uint32_t side = round % 2 == 0 ? 65536 : 30011;
        image::AlphaTexture texture =
            texture8(wide ? side : 1 + random.below(2), wide ? 1 + random.below(2) : side,
                     [&](uint32_t, uint32_t) { return random.below(4) != 0 ? 255 : 0; });
        texture.wrapU = static_cast<image::Wrap>(random.below(3));
        texture.wrapV = static_cast<image::Wrap>(random.below(3));
        texture.filter = static_cast<image::Filter>(random.below(3));
        const image::AlphaTest test = randomTest(random);
        mesh::UvTriangle t = random.triangle(1);
        const float size = std::ldexp(1.0F, -static_cast<int>(random.below(16)));
        for (mesh::Uv& p : t.uv) (wide ? p.u : p.v) *= size;
        check({&t, 1}, texture, test, 2 + random.below(4), totals);
    }
    EXPECT_LE(totals.share(), 0.003);
}

}  // namespace
}  // namespace filigree::bake::tests
