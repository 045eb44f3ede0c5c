#include "filigree/grid/cluster.h"

#include "filigree/core/bytes.h"
#include "filigree/core/target.h"
#include "filigree/grid/convert.h"
#include "filigree/grid/encoded_grids.h"

#include "grid/sample_meshes.h"

#include <cstring>
#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace filigree::grid {
namespace {

using namespace filigree::tests;
using LatticeTriangle = std::array<LatticePoint, 3>;

// All faces of a mesh as loose triangles.
GridMesh allLoose(const FaceMesh& mesh) {
    GridMesh loose;
    loose.looseVertices = mesh.positions;
    for (const auto& [a, b, c, d] : mesh.faces) {
        loose.looseTriangles.push_back({a, b, c});
        if (d != noVertex) loose.looseTriangles.push_back({a, c, d});
    }
    for (uint32_t t = 0; t < loose.looseTriangles.size(); ++t) loose.looseSources.push_back(t);
    return loose;
}

Lattice latticeOf(double step) {
    Lattice lattice;
    lattice.origin = {-100, -100, -100};
    lattice.step = {step, step, step};
    return lattice;
}

LatticeTriangle onLattice(const GridMesh& mesh, size_t t, const Lattice& lattice) {
    LatticeTriangle points;
    for (size_t k = 0; k < 3; ++k) points[k] = lattice.pointAt(mesh.looseVertices[mesh.looseTriangles[t][k]]);
    return points;
}

LatticeTriangle decodedTriangle(const ClusterTriangles& cluster, size_t t) {
    LatticeTriangle points;
    for (size_t k = 0; k < 3; ++k) {
        const size_t vertex = cluster.corners[k][t];
        EXPECT_LT(vertex, cluster.vertexCount);
        for (size_t axis = 0; axis < 3; ++axis) points[k][axis] = cluster.vertices[axis][vertex];
    }
    return points;
}

void expectEqual(const ClusterTriangles& a, const ClusterTriangles& b) {
    ASSERT_EQ(a.firstTriangle, b.firstTriangle);
    ASSERT_EQ(a.triangleCount, b.triangleCount);
    ASSERT_EQ(a.vertexCount, b.vertexCount);
    for (size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(std::memcmp(a.vertices[k].data(), b.vertices[k].data(), 4 * a.vertexCount), 0);
        EXPECT_EQ(std::memcmp(a.corners[k].data(), b.corners[k].data(), a.triangleCount), 0);
    }
}

// With zeros behind it, as records have.
std::vector<uint8_t> withSlack(std::vector<uint8_t> records) {
    records.resize(records.size() + EncodedGrids::recordSlack);
    return records;
}

// Both decoders give back `count` triangles from `first` on, to the vertex.
void expectRoundTrip(const GridMesh& mesh, uint32_t first, uint32_t count, const Lattice& lattice) {
    std::vector<uint8_t> record;
    appendCluster(mesh, first, count, lattice, record);
    ASSERT_EQ(record.size() % EncodedGrids::recordUnit, 0U);
    const auto size = checkCluster(record, static_cast<uint32_t>(mesh.looseTriangles.size()));
    ASSERT_TRUE(size.ok()) << size.error().message;
    EXPECT_EQ(*size, record.size());
    record = withSlack(std::move(record));
    const auto plain = std::make_unique<ClusterTriangles>();
    const auto fast = std::make_unique<ClusterTriangles>();
    decodeClusterPlain(record.data(), *plain);
    decodeCluster(record.data(), *fast);
    expectEqual(*plain, *fast);
    ASSERT_EQ(plain->firstTriangle, first);
    ASSERT_EQ(plain->triangleCount, count);
    for (uint32_t t = 0; t < count; ++t)
        ASSERT_EQ(decodedTriangle(*plain, t), onLattice(mesh, first + t, lattice)) << t;
}

// The same triangles with their sources, turned at most.
void expectSameLoose(const GridMesh& before, const GridMesh& after) {
    ASSERT_EQ(after.looseTriangles.size(), before.looseTriangles.size());
    ASSERT_EQ(after.looseSources.size(), before.looseSources.size());
    std::vector<bool> found(before.looseTriangles.size());
    for (size_t t = 0; t < after.looseTriangles.size(); ++t) {
        const uint32_t source = after.looseSources[t];
        EXPECT_FALSE(found[source]);
        found[source] = true;
        std::array<uint32_t, 3> triangle = after.looseTriangles[t];
        size_t turns = 0;
        for (; turns < 3 && triangle != before.looseTriangles[source]; ++turns)
            std::rotate(triangle.begin(), triangle.begin() + 1, triangle.end());
        EXPECT_LT(turns, 3U) << "triangle " << source << " changed";
    }
}

std::vector<uint32_t> expectClusters(const FaceMesh& mesh, const Lattice& lattice) {
    const GridMesh before = allLoose(mesh);
    GridMesh after = before;
    const std::vector<uint32_t> begins = clusterLoose(after, serialExecutor());
    expectSameLoose(before, after);
    EXPECT_EQ(begins.front(), 0U);
    EXPECT_EQ(begins.back(), after.looseTriangles.size());
    for (size_t k = 0; k + 1 < begins.size(); ++k) {
        EXPECT_LT(begins[k], begins[k + 1]);
        EXPECT_LE(begins[k + 1] - begins[k], maxClusterTriangles);
        expectRoundTrip(after, begins[k], begins[k + 1] - begins[k], lattice);
    }
    return begins;
}

TEST(Cluster, SheetFillsItsClusters) {
    const std::vector<uint32_t> begins = expectClusters(quadSheet({40, 40}), latticeOf(1e-4));
    EXPECT_LT(begins.size() - 1, 3200 / 64 * 1.3);
}

TEST(Cluster, NastyMeshesComeBack) {
    for (unsigned seed = 0; seed < 150; ++seed) {
        SCOPED_TRACE(seed);
        expectClusters(seed % 5 == 0 ? tangle(seed) : nasty(seed), latticeOf(seed % 2 == 0 ? 1e-4 : 0.3));
        if (HasFailure()) return;
    }
}

TEST(Cluster, LooseOnesAreGatheredIntoFewClusters) {
    FaceMesh mesh;
    std::mt19937 random(1);
    for (uint32_t k = 0; k < 640; ++k) {
        const Vec3 at{10 * coordinate(random), 10 * coordinate(random), 10 * coordinate(random)};
        for (size_t corner = 0; corner < 3; ++corner)
            mesh.positions.push_back(plus(at, times({coordinate(random), coordinate(random), 0}, 0.1F)));
        mesh.faces.push_back({3 * k, 3 * k + 1, 3 * k + 2, noVertex});
    }
    EXPECT_LT(expectClusters(mesh, latticeOf(1e-4)).size(), 80U);  // not 640
}

TEST(Cluster, AnyTrianglesInAnyOrder) {
    for (unsigned seed = 0; seed < 40; ++seed) {
        SCOPED_TRACE(seed);
        const GridMesh mesh = allLoose(tangle(seed));
        const auto all = static_cast<uint32_t>(mesh.looseTriangles.size());
        for (const uint32_t count : {1U, 2U, 17U, 63U, 64U}) {
            expectRoundTrip(mesh, 0, count, latticeOf(1e-5));
            expectRoundTrip(mesh, all - count, count, latticeOf(1e-5));
        }
    }
}

TEST(Cluster, MostVerticesAndWidestOffsets) {
    GridMesh mesh;
    std::mt19937 random(7);
    for (uint32_t t = 0; t < 64; ++t) {
        for (size_t k = 0; k < 3; ++k) {
            mesh.looseVertices.push_back({static_cast<float>(random() % latticeLimit),
                                          static_cast<float>(random() % latticeLimit),
                                          static_cast<float>(random() % latticeLimit)});
        }
        mesh.looseTriangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
    expectRoundTrip(mesh, 0, 64, Lattice{});
    for (Vec3& v : mesh.looseVertices) v = {v[0], v[1], 5};
    expectRoundTrip(mesh, 0, 64, Lattice{});
    for (Vec3& v : mesh.looseVertices) v = {3, 4, 5};
    expectRoundTrip(mesh, 0, 64, Lattice{});
}

// A slanted plane costs what a level one does.
TEST(Cluster, TiltTakesASlopeOut) {
    GridMesh mesh = allLoose(quadSheet({4, 4}));
    for (Vec3& p : mesh.looseVertices) p = {1000 * p[0], 0, 1000 * p[2]};
    std::vector<uint8_t> level;
    appendCluster(mesh, 0, 32, Lattice{}, level);
    for (Vec3& p : mesh.looseVertices) p[1] = (9 * p[0] + 17 * p[2]) / 32;
    std::vector<uint8_t> slanted;
    appendCluster(mesh, 0, 32, Lattice{}, slanted);
    EXPECT_LE(slanted.size(), level.size() + 8);
    expectRoundTrip(mesh, 0, 32, Lattice{});
}

TEST(Cluster, EveryTargetDecodesTheSame) {
    GridMesh mesh = allLoose(tangle(3));
    const std::vector<uint32_t> begins = clusterLoose(mesh, serialExecutor());
    for (const char* target : {"scalar", "best"}) {
        ASSERT_TRUE(forceTarget(target).ok());
        for (size_t k = 0; k + 1 < begins.size(); ++k)
            expectRoundTrip(mesh, begins[k], begins[k + 1] - begins[k], latticeOf(1e-3));
    }
}

TEST(Cluster, SameForAnyExecutor) {
    GridMesh one = allLoose(nasty(4));
    GridMesh four = one;
    const auto pool = makeThreadedExecutor(4);
    EXPECT_EQ(clusterLoose(one, serialExecutor()), clusterLoose(four, *pool));
    EXPECT_EQ(one.looseTriangles, four.looseTriangles);
}

TEST(Cluster, NoTrianglesNoClusters) {
    GridMesh mesh;
    EXPECT_THAT(clusterLoose(mesh, serialExecutor()), testing::ElementsAre(0U));
}

class ClusterBytes : public testing::Test {
  protected:
    ClusterBytes() {
        mesh_ = allLoose(nasty(6));
        clusterLoose(mesh_, serialExecutor());
        appendCluster(mesh_, 0, 40, latticeOf(1e-3), record_);
    }
    [[nodiscard]] std::string failure(const std::vector<uint8_t>& bytes) const {
        const auto size = checkCluster(bytes, static_cast<uint32_t>(mesh_.looseTriangles.size()));
        return size.ok() ? "no error" : size.error().message;
    }
    [[nodiscard]] std::string failureWith(size_t word, uint32_t set, uint32_t clear) const {
        std::vector<uint8_t> bytes = record_;
        storeLe(&bytes[4 * word], (loadLe<uint32_t>(&bytes[4 * word]) & ~clear) | set);
        return failure(bytes);
    }
    GridMesh mesh_;
    std::vector<uint8_t> record_;
};

TEST_F(ClusterBytes, EveryPrefixFails) {
    for (size_t length = 0; length < record_.size(); ++length) {
        const std::vector<uint8_t> prefix(record_.begin(), record_.begin() + static_cast<ptrdiff_t>(length));
        EXPECT_THAT(failure(prefix), testing::StartsWith("cluster: ")) << length;
    }
    std::vector<uint8_t> longer = record_;
    longer.push_back(0xff);
    EXPECT_EQ(*checkCluster(longer, 1000000), record_.size());
}

TEST_F(ClusterBytes, BrokenHeadersAreNamed) {
    EXPECT_EQ(failureWith(1, 0x80000000, 0), "cluster: unused bits of the header are not zero");
    EXPECT_EQ(failureWith(1, 0x60000000, 0), "cluster: tilted axis 3, expected at most 2");
    EXPECT_EQ(failureWith(2, 25U << 24, 31U << 24), "cluster: width 25, expected at most 24");
    EXPECT_THAT(failureWith(4, 255U << 6, 0), testing::HasSubstr("256 vertices"));
    EXPECT_THAT(failureWith(4, 40U << 14, 63U << 14), testing::HasSubstr("41 roots for 40"));
    EXPECT_THAT(failureWith(0, 0x7fffffff, 0), testing::HasSubstr("expected below"));
}

// Whatever a flipped bit gives decodes without leaving the arrays, or is refused.
TEST_F(ClusterBytes, FlippedBitsAreRefusedOrHarmless) {
    const auto plain = std::make_unique<ClusterTriangles>();
    const auto fast = std::make_unique<ClusterTriangles>();
    for (size_t bit = 0; bit < 8 * record_.size(); ++bit) {
        std::vector<uint8_t> bytes = record_;
        bytes[bit / 8] ^= static_cast<uint8_t>(1U << bit % 8);
        if (!checkCluster(bytes, UINT32_MAX)) continue;
        bytes = withSlack(std::move(bytes));
        decodeClusterPlain(bytes.data(), *plain);
        decodeCluster(bytes.data(), *fast);
        expectEqual(*plain, *fast);
        for (uint32_t t = 0; t < plain->triangleCount; ++t) {
            for (size_t k = 0; k < 3; ++k) ASSERT_LT(plain->corners[k][t], plain->vertexCount);
        }
    }
}

}  // namespace
}  // namespace filigree::grid
