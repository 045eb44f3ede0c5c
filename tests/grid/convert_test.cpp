#include "filigree/grid/convert.h"

#include "filigree/grid/shapes.h"
#include "filigree/grid/statistics.h"
#include "filigree/io/ply.h"

#include "grid/sample_meshes.h"
#include "grid/triangles_of.h"
#include "shared_data.h"

#include <chrono>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace filigree::grid {
namespace {

using namespace filigree::tests;
using Corners = std::array<Vec3, 3>;

// The triangle beginning at its least vertex, its winding kept; -0 as 0.
Corners canonical(Corners corners) {
    for (Vec3& corner : corners) {
        for (float& x : corner) x += 0.0F;
    }
    std::rotate(corners.begin(), std::ranges::min_element(corners), corners.end());
    return corners;
}

std::vector<Corners> trianglesOf(const FaceMesh& mesh) {
    std::vector<Corners> triangles;
    const auto at = [&](uint32_t v) { return mesh.positions[v]; };
    for (const auto& [a, b, c, d] : mesh.faces) {
        triangles.push_back(canonical({at(a), at(b), at(c)}));
        if (d != noVertex) triangles.push_back(canonical({at(a), at(c), at(d)}));
    }
    return triangles;
}

// The numbers of the source triangles in the order of forEachTriangle.
std::vector<uint32_t> sourcesOf(const GridMesh& grids) {
    std::vector<uint32_t> sources;
    for (const auto& [first, second] : grids.quadSources) sources.insert(sources.end(), {first, second});
    sources.insert(sources.end(), grids.looseSources.begin(), grids.looseSources.end());
    return sources;
}

// Each source triangle is there once, in its place and with its winding.
void expectSameTriangles(const FaceMesh& mesh, const GridMesh& grids) {
    const std::vector<Corners> expected = trianglesOf(mesh);
    const std::vector<uint32_t> sources = sourcesOf(grids);
    ASSERT_EQ(grids.triangleCount(), expected.size());
    ASSERT_EQ(sources.size(), expected.size());
    std::vector<bool> found(expected.size());
    size_t at = 0;
    forEachTriangle(grids, [&](const Corners& corners) {
        const uint32_t source = sources[at++];
        ASSERT_LT(source, expected.size());
        EXPECT_EQ(canonical(corners), expected[source]) << "source triangle " << source;
        EXPECT_FALSE(found[source]) << "source triangle " << source << " twice";
        found[source] = true;
    });
}

void expectSoundGrids(const GridMesh& grids) {
    uint64_t vertices = 0;
    uint64_t quads = 0;
    for (const VertexGrid& grid : grids.grids) {
        EXPECT_GE(grid.columns, 2U);
        EXPECT_GE(grid.rows, 2U);
        EXPECT_EQ(grid.firstVertex, vertices);
        EXPECT_EQ(grid.firstQuad, quads);
        vertices += grid.vertexCount();
        quads += grid.quadCount();
    }
    EXPECT_EQ(grids.vertices.size(), vertices);
    EXPECT_TRUE(grids.diagonals.empty() || grids.diagonals.size() == quads);
    EXPECT_EQ(grids.quadSources.size(), quads);
    EXPECT_EQ(grids.looseSources.size(), grids.looseTriangles.size());
}

GridMesh converted(const FaceMesh& mesh, const ConvertOptions& options = {}) {
    const auto grids = gridsOf(mesh, options, serialExecutor());
    EXPECT_TRUE(grids.ok()) << grids.error().message;
    expectSoundGrids(*grids);
    if (!options.turnQuads) expectSameTriangles(mesh, *grids);
    return *grids;
}

void expectOneGrid(const GridMesh& grids, uint32_t columns, uint32_t rows) {
    ASSERT_EQ(grids.grids.size(), 1U);
    const VertexGrid& grid = grids.grids[0];
    EXPECT_EQ(std::minmax(grid.columns, grid.rows), std::minmax(columns, rows));
    EXPECT_TRUE(grids.looseTriangles.empty());
}

TEST(Convert, SheetOfQuadsIsOneGrid) {
    const FaceMesh mesh = quadSheet({20, 13});
    expectOneGrid(converted(mesh), 21, 14);
    expectOneGrid(converted(shuffled(mesh, 1)), 21, 14);
    expectOneGrid(converted(soup(mesh)), 21, 14);
}

TEST(Convert, SheetOfTrianglesIsOneGrid) {
    for (const SheetShape shape : {SheetShape{20, 13}, SheetShape{64, 4}, SheetShape{33, 33}}) {
        const FaceMesh mesh = inTriangles(quadSheet(shape));
        for (unsigned seed = 0; seed < 4; ++seed) {
            SCOPED_TRACE(seed);
            const GridMesh grids = converted(soup(shuffled(mesh, seed)));
            expectOneGrid(grids, shape.columns + 1, shape.rows + 1);
            EXPECT_TRUE(grids.diagonals.empty());
        }
    }
}

TEST(Convert, SheetOfOtherDiagonalsIsOneGrid) {
    const GridMesh grids = converted(inTriangles(quadSheet({20, 13}), 256));
    expectOneGrid(grids, 21, 14);
    EXPECT_TRUE(grids.diagonals.empty());
}

TEST(Convert, SheetOfMixedDiagonalsIsOneGrid) {
    const FaceMesh mesh = inTriangles(quadSheet({40, 30}), 128);
    const GridMesh grids = converted(shuffled(mesh, 3));
    expectOneGrid(grids, 41, 31);
    EXPECT_FALSE(grids.diagonals.empty());
}

TEST(Convert, UniformDiagonalsKeepToOne) {
    ConvertOptions options;
    options.uniformDiagonals = true;
    for (const unsigned turned : {0U, 3U, 128U}) {
        const FaceMesh mesh = inTriangles(quadSheet({40, 30}), turned);
        const GridMesh grids = converted(shuffled(mesh, 3), options);
        EXPECT_TRUE(grids.diagonals.empty());
        if (turned == 0) expectOneGrid(grids, 41, 31);
        if (turned == 3) {
            EXPECT_GT(statisticsOf(grids).inGridShare(), 0.8);
        }
    }
}

TEST(Convert, QuadsMayBeTurned) {
    const FaceMesh mesh = shuffled(quadSheet({20, 13}), 1);
    EXPECT_FALSE(converted(mesh).diagonals.empty());
    ConvertOptions options;
    options.uniformDiagonals = options.turnQuads = true;
    const GridMesh grids = converted(mesh, options);
    expectOneGrid(grids, 21, 14);
    EXPECT_TRUE(grids.diagonals.empty());
    std::vector<uint32_t> sources = sourcesOf(grids);
    std::ranges::sort(sources);
    for (uint32_t t = 0; t < sources.size(); ++t) EXPECT_EQ(sources[t], t);
}

TEST(Convert, ClosedSurfacesHaveASeam) {
    const GridMesh ring = converted(inTriangles(quadSheet({24, 9, true, false})));
    expectOneGrid(ring, 25, 10);
    const GridMesh torus = converted(inTriangles(quadSheet({24, 18, true, true})));
    expectOneGrid(torus, 25, 19);
    const VertexGrid& grid = torus.grids[0];
    for (uint32_t row = 0; row < grid.rows; ++row)
        EXPECT_EQ(torus.vertices[row * grid.columns], torus.vertices[(row + 1) * grid.columns - 1]);
}

TEST(Convert, PolesStayLoose) {
    const GridMesh grids = converted(shuffled(ball(32, 20), 1));
    expectSoundGrids(grids);
    EXPECT_EQ(statisticsOf(grids).trianglesInGrids, 32U * 18 * 2);
    EXPECT_EQ(grids.grids.size(), 1U);
    EXPECT_EQ(grids.looseTriangles.size(), 64U);
}

TEST(Convert, MoebiusStripIsAGridOrTwo) {
    for (const FaceMesh& mesh : {moebius(40, 6), inTriangles(moebius(40, 6))}) {
        const GridMesh grids = converted(mesh);
        EXPECT_LE(grids.grids.size(), 2U);
        EXPECT_GT(statisticsOf(grids).inGridShare(), 0.9);
    }
}

TEST(Convert, CubeOfFewQuadsStaysLoose) {
    FaceMesh cube;
    for (uint32_t k = 0; k < 8; ++k)
        cube.positions.push_back(
            {static_cast<float>(k & 1), static_cast<float>(k >> 1 & 1), static_cast<float>(k >> 2)});
    cube.faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    const GridMesh grids = converted(cube);
    EXPECT_TRUE(grids.grids.empty());
    EXPECT_EQ(grids.looseTriangles.size(), 12U);
    EXPECT_EQ(grids.looseVertices.size(), 8U);
}

TEST(Convert, NothingGivesNothing) {
    EXPECT_EQ(converted({}).triangleCount(), 0U);
}

TEST(Convert, SurfaceWithABackGivesTwoGrids) {
    FaceMesh mesh = inTriangles(quadSheet({20, 13}));
    const std::vector<mesh::Face> front = mesh.faces;
    for (const auto& [a, b, c, d] : front) mesh.faces.push_back({a, c, b, d});
    const GridMesh grids = converted(mesh);
    EXPECT_EQ(grids.grids.size(), 2U);
    EXPECT_TRUE(grids.looseTriangles.empty());
}

TEST(Convert, AttributesCutGridsOnlyWhereKept) {
    FaceMesh mesh = soup(quadSheet({16, 16}));
    mesh.uvs.resize(mesh.positions.size());
    for (size_t v = 0; v < mesh.uvs.size(); ++v) {
        const size_t column = v / 4 % 16;
        mesh.uvs[v] = {mesh.positions[v][0] + (column < 8 ? 0 : 100), mesh.positions[v][2]};
    }
    const GridMesh kept = converted(mesh);
    EXPECT_EQ(kept.grids.size(), 2U);
    ASSERT_EQ(kept.uvs.size(), kept.vertices.size());
    for (size_t v = 0; v < kept.uvs.size(); ++v) {
        EXPECT_EQ(std::fmod(kept.uvs[v].u, 100.0F), kept.vertices[v][0]);
        EXPECT_EQ(kept.uvs[v].v, kept.vertices[v][2]);
    }
    ConvertOptions options;
    options.attributes = false;
    const GridMesh plain = converted(mesh, options);
    expectOneGrid(plain, 17, 17);
    EXPECT_TRUE(plain.uvs.empty());
}

TEST(Convert, NastyMeshesKeepTheirTriangles) {
    for (unsigned seed = 0; seed < 400; ++seed) {
        SCOPED_TRACE(seed);
        ConvertOptions options;
        options.uniformDiagonals = seed % 3 == 0;
        converted(nasty(seed), options);
        if (HasFailure()) return;
    }
}

TEST(Convert, TanglesKeepTheirTriangles) {
    for (unsigned seed = 0; seed < 100; ++seed) {
        SCOPED_TRACE(seed);
        converted(tangle(seed));
        if (HasFailure()) return;
    }
}

TEST(Convert, LongGridsAreCut) {
    const GridMesh grids = converted(quadSheet({65600, 3}));
    ASSERT_EQ(grids.grids.size(), 2U);
    EXPECT_EQ(std::max(grids.grids[0].columns, grids.grids[0].rows), 65536U);
}

TEST(Convert, DamageCostsLittle) {
    FaceMesh mesh = inTriangles(quadSheet({100, 100}));
    std::mt19937 random(5);
    for (size_t k = 0; k < 20; ++k) mesh.faces.erase(mesh.faces.begin() + random() % mesh.faces.size());
    EXPECT_GT(statisticsOf(converted(mesh)).shareAtLeast(4), 0.9);
}

TEST(Convert, SameForAnyExecutor) {
    const FaceMesh mesh = nasty(17);
    const auto pool = makeThreadedExecutor(4);
    const GridMesh one = converted(mesh);
    const auto four = gridsOf(mesh, {}, *pool);
    ASSERT_TRUE(four.ok());
    EXPECT_EQ(one.vertices, four->vertices);
    EXPECT_EQ(one.grids, four->grids);
    EXPECT_EQ(one.quadSources, four->quadSources);
    EXPECT_EQ(one.looseTriangles, four->looseTriangles);
}

TEST(Convert, RefusesBrokenMeshes) {
    const auto messageOf = [](const FaceMesh& mesh) {
        const auto grids = gridsOf(mesh, {}, serialExecutor());
        return grids.ok() ? std::string("no error") : grids.error().message;
    };
    FaceMesh mesh = quadSheet({2, 2});
    mesh.faces[3][1] = 9;
    EXPECT_EQ(messageOf(mesh), "face 3: vertex 9, expected below 9");
    mesh = quadSheet({2, 2});
    mesh.positions[4][1] = NAN;
    EXPECT_EQ(messageOf(mesh), "vertex 4: position (1, nan, 1), expected finite");
    mesh = quadSheet({2, 2});
    mesh.uvs.resize(4);
    EXPECT_EQ(messageOf(mesh), "4 texture coordinates for 9 vertices");
}

TEST(Statistics, CountsGridsByTheirShorterSide) {
    GridMesh mesh;
    mesh.grids = {{5, 9, 0, 0}, {4, 4, 45, 32}, {8, 30, 61, 41}};
    mesh.looseTriangles.resize(6);
    const GridStatistics statistics = statisticsOf(mesh);
    EXPECT_EQ(statistics.triangles, 2 * (32 + 9 + 203) + 6U);
    EXPECT_EQ(statistics.largestGrid, 203U);
    ASSERT_EQ(statistics.classes.size(), 2U);
    EXPECT_EQ(statistics.classes[0].side, 2U);
    EXPECT_EQ(statistics.classes[1].quads, 235U);
    EXPECT_DOUBLE_EQ(statistics.shareAtLeast(4), 470.0 / 494);
}

// Those of the issue: a plain list of triangles and real meshes.
TEST(ConvertReal, TerrainGivenAsTriangles) {
    const uint32_t n = std::getenv("FILIGREE_FULL") != nullptr ? 1025 : 257;
    FaceMesh mesh = inTriangles(quadSheet({n - 1, n - 1}));
    mesh.positions = grid::terrain(n, serialExecutor()).vertices;
    const auto start = std::chrono::steady_clock::now();
    const auto grids = gridsOf(mesh, {}, serialExecutor());
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    ASSERT_TRUE(grids.ok());
    expectOneGrid(*grids, n, n);
    EXPECT_TRUE(grids->diagonals.empty());
    EXPECT_LT(seconds.count(), 30);  // 1.5 in a release build
}

TEST(ConvertReal, TeddybearLiesInGrids) {
    FILIGREE_NEEDS_SHARED_DATA();
    const auto mesh = io::readPly(sharedData() / "data/meshes/teddybear_cc2.ply");
    ASSERT_TRUE(mesh.ok()) << mesh.error().message;
    EXPECT_EQ(mesh->triangleCount(), 440832U);
    const auto grids = gridsOf(*mesh, {}, serialExecutor());
    ASSERT_TRUE(grids.ok());
    EXPECT_GT(statisticsOf(*grids).shareAtLeast(4), 0.95);
}

}  // namespace
}  // namespace filigree::grid
