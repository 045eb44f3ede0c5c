#include "filigree/grid/rays.h"

#include "filigree/core/target.h"
#include "filigree/grid/check.h"
#include "filigree/grid/decode_grids.h"

#include "grid/sample_grids.h"
#include "grid/triangles_of.h"

#include <cmath>
#include <limits>
#include <random>
#include <string>

#include <gmock/gmock.h>

namespace filigree::grid {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

class Numbers {
  public:
    explicit Numbers(unsigned seed) : random_(seed) {}
    float between(float low, float high) {
        return low + (high - low) * (static_cast<float>(random_() >> 8) / 16777216.0F);
    }
    Vec3 point(float reach) {
        const float x = between(-reach, reach);
        const float y = between(-reach, reach);
        return {x, y, between(-reach, reach)};
    }

  private:
    std::mt19937 random_;
};

// Encoded grids with the triangles they decode to.
struct Sample {
    Sample(GridMesh source, Codec codec, double error = 1e-4) : mesh(std::move(source)) {
        EncodeOptions options;
        options.codec = codec;
        if (codec == Codec::lattice) options.lattice = latticeForError(mesh, error).value();
        grids = tests::encoded(mesh, options);
        decoded = decodedMesh(grids, mesh, serialExecutor());
        forEachTriangle(decoded, [&](const std::array<Vec3, 3>& corners) { triangles.push_back(corners); });
    }

    GridMesh mesh;
    EncodedGrids grids;
    GridMesh decoded;
    std::vector<std::array<Vec3, 3>> triangles;
};

std::vector<Ray> raysAt(const Sample& sample, size_t count, unsigned seed) {
    Numbers numbers(seed);
    std::vector<Ray> rays;
    for (size_t k = 0; k < count; ++k) {
        const auto& corners = sample.triangles[(k * 7919) % sample.triangles.size()];
        const Vec3 origin = numbers.point(2);
        Vec3 target = corners[0];
        if (k % 3 != 0) target = times(plus(plus(corners[0], corners[1]), corners[2]), 1.0F / 3);
        Ray ray{origin, minus(target, origin)};
        if (k % 5 == 0) ray.direction[k % 3] = 0;
        if (k % 15 == 0) ray.direction[(k + 1) % 3] = -0.0F;
        if (k % 4 == 0) ray.tMax = numbers.between(0, 1.5F);
        if (k % 6 == 0) ray.tMin = numbers.between(0, 1);
        rays.push_back(ray);
    }
    return rays;
}

std::array<double, 3> crossOf(const std::array<double, 3>& a, const std::array<double, 3>& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dotOf(const std::array<double, 3>& a, const std::array<double, 3>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Möller and Trumbore in double; a hit counts from `margin` inside the edges on.
struct JudgeHit {
    bool isHit = false;
    double t = 0;
};
JudgeHit judge(const std::array<Vec3, 3>& corners, const Ray& ray, double margin) {
    std::array<double, 3> ab{}, ac{}, from{}, along{};
    for (size_t k = 0; k < 3; ++k) {
        ab[k] = double{corners[1][k]} - corners[0][k];
        ac[k] = double{corners[2][k]} - corners[0][k];
        from[k] = double{ray.origin[k]} - corners[0][k];
        along[k] = ray.direction[k];
    }
    const auto p = crossOf(along, ac);
    const double determinant = dotOf(ab, p);
    if (determinant == 0) return {};
    const double u = dotOf(from, p) / determinant;
    const auto q = crossOf(from, ab);
    const double v = dotOf(along, q) / determinant;
    if (u < margin || v < margin || u + v > 1 - margin) return {};
    return {true, dotOf(ac, q) / determinant};
}

// Against brute force: no hit that is clear in double is missed, and none made up.
void expectAgrees(const Sample& sample, const std::vector<Ray>& rays) {
    Tracer tracer(sample.grids);
    constexpr double slack = 2e-4;
    size_t hits = 0;
    for (const Ray& ray : rays) {
        double surely = infinity, perhaps = infinity;
        const Hit hit = tracer.closest(ray);
        bool isFound = hit.grid == noGrid;
        for (const auto& corners : sample.triangles) {
            const JudgeHit sure = judge(corners, ray, 1e-3);
            const JudgeHit maybe = judge(corners, ray, -2e-2);
            if (sure.isHit && sure.t > ray.tMin + slack && sure.t < ray.tMax - slack)
                surely = std::min(surely, sure.t);
            if (maybe.isHit && maybe.t > ray.tMin - slack && maybe.t < ray.tMax + slack) {
                perhaps = std::min(perhaps, maybe.t);
                isFound = isFound || std::abs(maybe.t - hit.t) < slack;
            }
        }
        ASSERT_LE(hit.t, surely + slack);
        if (hit.grid == noGrid) continue;
        ++hits;
        ASSERT_GE(hit.t, perhaps - slack);
        ASSERT_TRUE(isFound);
        ASSERT_GE(hit.t, ray.tMin);
        ASSERT_LE(hit.t, ray.tMax);
    }
    EXPECT_GT(hits, rays.size() / 4);
}

// The triangle that a hit names, of the decoded mesh.
std::array<Vec3, 3> triangleOf(const Sample& sample, const Hit& hit) {
    if (hit.grid == looseGrid) return sample.triangles[2 * sample.mesh.quadCount() + hit.column];
    const VertexGrid& grid = sample.mesh.grids[hit.grid];
    return sample
        .triangles[2 * (grid.firstQuad + uint64_t{hit.row} * (grid.columns - 1) + hit.column) + hit.half];
}

void expectNamesWhatItHits(const Sample& sample, const std::vector<Ray>& rays) {
    Tracer tracer(sample.grids);
    for (const Ray& ray : rays) {
        const Hit hit = tracer.closest(ray);
        if (hit.grid == noGrid) continue;
        const auto corners = triangleOf(sample, hit);
        const Vec3 across = minus(corners[1], corners[0]);
        const Vec3 down = minus(corners[2], corners[0]);
        const Vec3 place = plus(corners[0], plus(times(across, hit.u), times(down, hit.v)));
        const Vec3 met = plus(ray.origin, times(ray.direction, hit.t));
        for (size_t k = 0; k < 3; ++k) ASSERT_NEAR(place[k], met[k], 1e-3);
        const Vec3 normal = cross(across, down);
        const float length = std::sqrt(dot(normal, normal));
        for (size_t k = 0; k < 3; ++k) ASSERT_NEAR(hit.normal[k], normal[k], 1e-3F * length);
    }
}

bool same(const Hit& a, const Hit& b) {
    return a.t == b.t && a.grid == b.grid && a.column == b.column && a.row == b.row && a.half == b.half &&
           a.u == b.u && a.v == b.v && a.normal == b.normal;
}

class Rays : public testing::TestWithParam<Codec> {
  protected:
    static GridMesh torusMesh() { return torus(43, serialExecutor()); }
};
INSTANTIATE_TEST_SUITE_P(OfCodec, Rays, testing::Values(Codec::paper, Codec::lattice),
                         [](const auto& of) { return std::string(nameOf(of.param)); });

TEST_P(Rays, AgreeWithBruteForce) {
    const Sample ring(torusMesh(), GetParam());
    expectAgrees(ring, raysAt(ring, 300, 1));
    expectNamesWhatItHits(ring, raysAt(ring, 3000, 2));
}

TEST_P(Rays, AgreeWithBruteForceWhereSomeIsLoose) {
    if (GetParam() == Codec::paper) {
        GridMesh mesh = tests::withLastGridLoose(box(11, serialExecutor()));
        mesh.diagonals.clear();
        const Sample mixed(mesh, GetParam());
        expectAgrees(mixed, raysAt(mixed, 300, 3));
        expectNamesWhatItHits(mixed, raysAt(mixed, 3000, 4));
        return;
    }
    const Sample mixed(tests::mixedBox(11), GetParam());
    expectAgrees(mixed, raysAt(mixed, 300, 3));
    expectNamesWhatItHits(mixed, raysAt(mixed, 3000, 4));
}

TEST_P(Rays, AreTheSameOnEveryInstructionSet) {
    const Sample ring(torusMesh(), GetParam());
    const auto rays = raysAt(ring, 4000, 5);
    std::vector<Hit> hits;
    {
        Tracer tracer(ring.grids);
        for (const Ray& ray : rays) hits.push_back(tracer.closest(ray));
    }
    for (const char* target : {"scalar", "sse4", "avx2", "avx3"}) {
        if (!forceTarget(target)) continue;
        Tracer tracer(ring.grids);
        for (size_t k = 0; k < rays.size(); ++k)
            EXPECT_TRUE(same(tracer.closest(rays[k]), hits[k])) << target << ", ray " << k;
    }
    ASSERT_TRUE(forceTarget("best"));
    ASSERT_TRUE(forceTargetFromEnvironment());
}

TEST_P(Rays, AreTheSameManyAtOnceAndOneByOne) {
    const Sample ring(torusMesh(), GetParam());
    const auto rays = raysAt(ring, 5000, 6);
    Tracer many(ring.grids);
    Tracer one(ring.grids);
    std::vector<Hit> hits(rays.size());
    std::vector<uint8_t> answers(rays.size());
    many.closest(rays, hits);
    many.any(rays, answers);
    for (size_t k = 0; k < rays.size(); ++k) {
        ASSERT_TRUE(same(one.closest(rays[k]), hits[k])) << "ray " << k;
        ASSERT_EQ(answers[k] == 1, hits[k].grid != noGrid) << "ray " << k;
        ASSERT_EQ(one.any(rays[k]), answers[k] == 1) << "ray " << k;
    }
    many.closest({}, {});
}

TEST_P(Rays, KeepToTheirEnds) {
    const Sample ring(torusMesh(), GetParam());
    Tracer tracer(ring.grids);
    const Ray through{{-3, 0.01F, 0.02F}, {1, 0, 0}};
    const Hit first = tracer.closest(through);
    ASSERT_NE(first.grid, noGrid);
    EXPECT_EQ(tracer.closest({through.origin, through.direction, 0, first.t}).t, first.t);
    EXPECT_EQ(tracer.closest({through.origin, through.direction, first.t, infinity}).t, first.t);
    EXPECT_FALSE(tracer.any({through.origin, through.direction, 0, std::nextafter(first.t, 0.0F)}));
    const Hit second =
        tracer.closest({through.origin, through.direction, std::nextafter(first.t, infinity), infinity});
    EXPECT_GT(second.t, first.t);
    EXPECT_FALSE(tracer.any({through.origin, through.direction, 2, 1}));
    // Backwards, as the ends allow.
    EXPECT_TRUE(tracer.any({{3, 0.01F, 0.02F}, {1, 0, 0}, -infinity, 0}));
}

TEST_P(Rays, HitWhatIsFarAway) {
    const Sample ring(torusMesh(), GetParam());
    Tracer tracer(ring.grids);
    for (const float far : {100.0F, 1e4F, 1e8F, 1e20F}) {
        const Hit hit = tracer.closest({{0.9F, far, 0.1F}, {0, -1, 0}});
        ASSERT_NE(hit.grid, noGrid) << far;
        EXPECT_NEAR(hit.t / far, 1, 0.01F);
        EXPECT_FALSE(tracer.any({{30, far, 0.1F}, {0, -1, 0}}));
    }
}

TEST_P(Rays, OfAnyLengthHitTheSame) {
    const Sample ring(torusMesh(), GetParam());
    Tracer tracer(ring.grids);
    const Hit hit = tracer.closest({{-3, 0.01F, 0.02F}, {1, 0, 0}});
    for (const float length : {1e-30F, 1e-6F, 8.0F, 1e20F}) {
        const Hit other = tracer.closest({{-3, 0.01F, 0.02F}, {length, 0, 0}});
        EXPECT_EQ(other.column, hit.column);
        EXPECT_NEAR(other.t * length, hit.t, 1e-5);
    }
}

TEST_P(Rays, FromNowhereHitNothing) {
    const Sample ring(torusMesh(), GetParam());
    Tracer tracer(ring.grids);
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    for (const float odd : {nan, infinity}) {
        EXPECT_FALSE(tracer.any({{odd, 0, 0}, {1, 0, 0}}));
        EXPECT_FALSE(tracer.any({{-3, 0, 0}, {1, odd, 0}}));
    }
    EXPECT_FALSE(tracer.any({{-3, 0, 0}, {1, 0, 0}, nan, nan}));
}

// Rays from inside a closed surface at its vertices and edges.
template <class Inside>
void expectNoLeaks(const Sample& closed, const Inside& inside, size_t count) {
    Tracer tracer(closed.grids);
    Numbers numbers(7);
    size_t misses = 0;
    for (size_t k = 0; k < count; ++k) {
        const auto& corners = closed.triangles[(k / 4) % closed.triangles.size()];
        const Vec3& p = corners[k % 3];
        const Vec3& q = corners[(k + 1) % 3];
        const Vec3 target =
            k % 4 == 0 ? p : plus(p, times(minus(q, p), k % 4 == 1 ? 0.5F : numbers.between(0, 1)));
        const Vec3 origin = plus(inside(target), numbers.point(0.1F));
        misses += tracer.any({origin, minus(target, origin), 0, 1.001F}) ? 0U : 1U;
    }
    EXPECT_EQ(misses, 0U);
}

size_t leakRays() {
    return std::getenv("FILIGREE_FULL") != nullptr ? 20'000'000 : 500'000;
}

TEST(RaysLattice, FindNoLeakInATorus) {
    const auto behind = [](const Vec3& target) { return normalised({target[0], 0, target[2]}); };
    expectNoLeaks(Sample(torus(59, serialExecutor()), Codec::lattice, 1e-5), behind, leakRays());
}

TEST(RaysLattice, FindNoLeakInABoxOfGridsOutOfPhase) {
    const auto middle = [](const Vec3&) { return Vec3{}; };
    expectNoLeaks(Sample(box(22, serialExecutor()), Codec::lattice, 1e-5), middle, leakRays() / 2);
    expectNoLeaks(Sample(tests::mixedBox(22), Codec::lattice, 1e-5), middle, leakRays() / 2);
}

}  // namespace
}  // namespace filigree::grid
