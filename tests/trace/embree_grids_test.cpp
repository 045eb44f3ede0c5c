#include "filigree/trace/embree_grids.h"

#include "filigree/grid/shapes.h"

#include "trace/random.h"

#include <cmath>
#include <vector>

#include <gmock/gmock.h>

namespace filigree::trace {
namespace {

// From near the middle of a box in all directions.
std::vector<grid::Ray> raysFromWithin(size_t count) {
    RandomStream random(1, 2, 3);
    const auto centred = [&] { return 2 * random.next() - 1; };
    std::vector<grid::Ray> rays(count);
    for (grid::Ray& ray : rays) {
        ray.origin = times({centred(), centred(), centred()}, 0.3F);
        ray.direction = {centred(), centred(), centred()};
    }
    return rays;
}

EmbreeGrids built(const grid::GridMesh& mesh, EmbreeLayout layout) {
    auto grids = EmbreeGrids::build(mesh, layout, {.robust = true, .threads = 1});
    EXPECT_TRUE(grids) << grids.error().message;
    return std::move(*grids);
}

std::vector<EmbreeHit> hitsOf(const EmbreeGrids& grids, const std::vector<grid::Ray>& rays) {
    std::vector<EmbreeHit> hits(rays.size());
    grids.closest(rays, hits);
    return hits;
}

grid::GridMesh boxWithLooseLid() {
    grid::GridMesh mesh = grid::box(24, serialExecutor());
    mesh.looseVertices = {{-3, 4, -3}, {3, 4, -3}, {0, 4, 3}};
    mesh.looseTriangles = {{0, 1, 2}};
    return mesh;
}

TEST(EmbreeGrids, LayoutsHaveNames) {
    for (size_t k = 0; k < embreeLayoutCount; ++k) {
        const auto layout = static_cast<EmbreeLayout>(k);
        EXPECT_EQ(embreeLayoutNamed(nameOf(layout)), layout);
    }
    EXPECT_FALSE(embreeLayoutNamed("quads"));
}

TEST(EmbreeGrids, AllLayoutsHitTheSameSurface) {
    const grid::GridMesh mesh = boxWithLooseLid();
    const auto rays = raysFromWithin(4000);
    const auto expected = hitsOf(built(mesh, EmbreeLayout::triangles), rays);
    for (size_t k = 1; k < embreeLayoutCount; ++k) {
        const auto layout = static_cast<EmbreeLayout>(k);
        const auto hits = hitsOf(built(mesh, layout), rays);
        for (size_t r = 0; r < rays.size(); ++r)
            EXPECT_NEAR(hits[r].t, expected[r].t, 1e-5F * expected[r].t) << nameOf(layout) << " ray " << r;
    }
}

TEST(EmbreeGrids, LooseTrianglesAreHit) {
    const std::vector<grid::Ray> rays{{{0, 9, 0}, {0, -1, 0}}, {{9, 9, 0}, {0, -1, 0}}};
    for (const auto layout : {EmbreeLayout::triangles, EmbreeLayout::gridsCompact}) {
        const auto hits = hitsOf(built(boxWithLooseLid(), layout), rays);
        EXPECT_FLOAT_EQ(hits[0].t, 5);
        EXPECT_NEAR(std::fabs(normalised(hits[0].normal)[1]), 1, 1e-6);
        EXPECT_TRUE(std::isinf(hits[1].t));
    }
}

TEST(EmbreeGrids, StreamsAnswerAsSingleRaysDo) {
    auto rays = raysFromWithin(1000);
    for (grid::Ray& ray : rays) ray.tMax = 1;
    for (size_t layout = 0; layout < embreeLayoutCount; ++layout) {
        const EmbreeGrids grids = built(boxWithLooseLid(), static_cast<EmbreeLayout>(layout));
        const auto hits = hitsOf(grids, rays);
        std::vector<EmbreeHit> streamed(rays.size());
        std::vector<uint8_t> answers(rays.size());
        std::vector<uint8_t> streamedAnswers(rays.size());
        grids.closestStreamed(rays, streamed);
        grids.any(rays, answers);
        grids.anyStreamed(rays, streamedAnswers);
        for (size_t r = 0; r < rays.size(); ++r) {
            EXPECT_EQ(answers[r], std::isfinite(hits[r].t) ? 1 : 0);
            EXPECT_EQ(answers[r], std::isfinite(streamed[r].t) ? 1 : 0);
            if (answers[r] == 0) continue;
            EXPECT_NEAR(hits[r].t, streamed[r].t, 1e-6F * hits[r].t);
        }
        EXPECT_EQ(answers, streamedAnswers);
    }
}

TEST(EmbreeGrids, TakeLessMemoryAsGridsThanAsTriangles) {
    const grid::GridMesh mesh = grid::terrain(129, serialExecutor());
    const auto bytesOf = [&](EmbreeLayout layout) { return built(mesh, layout).bytes(); };
    EXPECT_LT(bytesOf(EmbreeLayout::trianglesCompact), bytesOf(EmbreeLayout::triangles));
    EXPECT_LT(3 * bytesOf(EmbreeLayout::grids), bytesOf(EmbreeLayout::triangles));
    EXPECT_GT(bytesOf(EmbreeLayout::gridsCompact), mesh.vertices.size() * sizeof(Vec3));
}

}  // namespace
}  // namespace filigree::trace
