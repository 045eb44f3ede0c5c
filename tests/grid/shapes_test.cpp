#include "filigree/grid/shapes.h"

#include "filigree/core/box.h"

#include "grid/triangles_of.h"

#include <bit>
#include <map>
#include <utility>

#include <gmock/gmock.h>

namespace filigree::grid {
namespace {

using Edge = std::pair<Vec3, Vec3>;

// How often each directed edge occurs, by position.
std::map<Edge, int> directedEdges(const GridMesh& mesh) {
    std::map<Edge, int> edges;
    forEachTriangle(mesh, [&](const std::array<Vec3, 3>& corners) {
        for (size_t k = 0; k < 3; ++k) ++edges[{corners[k], corners[(k + 1) % 3]}];
    });
    return edges;
}

// Six times the volume inside, positive where triangles face outwards.
double volumeOf(const GridMesh& mesh) {
    double volume = 0;
    forEachTriangle(mesh, [&](const std::array<Vec3, 3>& corners) {
        volume += double{dot(corners[0], cross(corners[1], corners[2]))};
    });
    return volume;
}

void expectClosed(const GridMesh& mesh) {
    const auto edges = directedEdges(mesh);
    for (const auto& [edge, count] : edges) {
        ASSERT_EQ(count, 1);
        ASSERT_TRUE(edges.contains({edge.second, edge.first}));
    }
    EXPECT_GT(volumeOf(mesh), 0);
}

uint64_t hashOf(const GridMesh& mesh) {
    uint64_t hash = 0;
    for (const Vec3& v : mesh.vertices) {
        for (const float x : v) hash = hash * 0x9E3779B97F4A7C15U + std::bit_cast<uint32_t>(x);
    }
    return hash;
}

TEST(Shapes, TorusAndBoxAreClosed) {
    expectClosed(torus(33, serialExecutor()));
    expectClosed(torus(70, serialExecutor()));
    expectClosed(box(8, serialExecutor()));
    expectClosed(box(21, serialExecutor()));
}

TEST(Shapes, GridsFollowEachOther) {
    const GridMesh mesh = box(37, serialExecutor());
    ASSERT_EQ(mesh.grids.size(), 4u);
    uint64_t vertices = 0;
    uint64_t quads = 0;
    for (const VertexGrid& grid : mesh.grids) {
        EXPECT_EQ(grid.firstVertex, vertices);
        EXPECT_EQ(grid.firstQuad, quads);
        vertices += grid.vertexCount();
        quads += grid.quadCount();
    }
    EXPECT_EQ(mesh.vertices.size(), vertices);
    EXPECT_EQ(mesh.diagonals.size(), quads);
    EXPECT_EQ(mesh.triangleCount(), 12u * 37 * 37);
}

TEST(Shapes, TerrainIsAHeightfieldThatFacesUp) {
    const uint32_t n = 65;
    const GridMesh mesh = terrain(n, serialExecutor());
    for (uint32_t row = 0; row < n; ++row) {
        for (uint32_t column = 0; column < n; ++column) {
            const Vec3& v = mesh.vertices[row * n + column];
            EXPECT_EQ(v[0], static_cast<float>(column) / (n - 1));
            EXPECT_EQ(v[2], 1 - static_cast<float>(row) / (n - 1));
            EXPECT_LT(std::abs(v[1]), 0.5F);
        }
    }
    forEachTriangle(mesh, [](const std::array<Vec3, 3>& corners) {
        EXPECT_GT(cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]))[1], 0);
    });
}

TEST(Shapes, AreTheSameForAnyExecutor) {
    const auto threads = makeThreadedExecutor(3);
    EXPECT_EQ(terrain(65, *threads).vertices, terrain(65, serialExecutor()).vertices);
    EXPECT_EQ(torus(65, *threads).vertices, torus(65, serialExecutor()).vertices);
    EXPECT_EQ(box(20, *threads).vertices, box(20, serialExecutor()).vertices);
}

TEST(Shapes, AreTheSameOnEveryMachine) {
    EXPECT_EQ(hashOf(terrain(65, serialExecutor())), 14033691325211258040u);
    EXPECT_EQ(hashOf(torus(65, serialExecutor())), 11881059726901209123u);
    EXPECT_EQ(hashOf(box(20, serialExecutor())), 18307028787614948411u);
}

TEST(Shapes, AreTheSameSurfaceAtEveryResolution) {
    const GridMesh coarse = terrain(33, serialExecutor());
    const GridMesh fine = terrain(65, serialExecutor());
    for (uint32_t row = 0; row < 33; ++row) {
        for (uint32_t column = 0; column < 33; ++column)
            EXPECT_EQ(coarse.vertices[row * 33 + column], fine.vertices[2 * (row * 65 + column)]);
    }
}

}  // namespace
}  // namespace filigree::grid
