// Any bytes as a cluster: the decoders agree on what the check lets through, and its triangles encode and
// decode to the same again.
#include "filigree/core/target.h"
#include "filigree/grid/cluster.h"
#include "filigree/grid/encoded_grids.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>

namespace {

using namespace filigree;
using namespace filigree::grid;

void fail(const char* what) {
    std::fprintf(stderr, "%s\n", what);
    std::abort();
}

void expectSameDecoded(const ClusterTriangles& a, const ClusterTriangles& b) {
    if (a.firstTriangle != b.firstTriangle || a.triangleCount != b.triangleCount ||
        a.vertexCount != b.vertexCount)
        fail("the decoders differ in their counts");
    for (size_t k = 0; k < 3; ++k) {
        if (std::memcmp(a.vertices[k].data(), b.vertices[k].data(), 4 * a.vertexCount) != 0 ||
            std::memcmp(a.corners[k].data(), b.corners[k].data(), a.triangleCount) != 0)
            fail("the decoders differ");
    }
}

LatticePoint cornerOf(const ClusterTriangles& cluster, size_t k, uint32_t t) {
    const size_t v = cluster.corners[k][t];
    if (v >= cluster.vertexCount) fail("a corner is no vertex");
    return {cluster.vertices[0][v], cluster.vertices[1][v], cluster.vertices[2][v]};
}

// The triangles of a decoded cluster, encoded anew.
std::vector<uint8_t> encodedAnew(const ClusterTriangles& cluster) {
    GridMesh mesh;
    for (uint32_t t = 0; t < cluster.triangleCount; ++t) {
        for (size_t k = 0; k < 3; ++k) {
            const LatticePoint p = cornerOf(cluster, k, t);
            mesh.looseVertices.push_back(
                {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
        }
        mesh.looseTriangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
    std::vector<uint8_t> record;
    appendCluster(mesh, 0, cluster.triangleCount, Lattice{}, record);
    return record;
}

void decodeBoth(std::vector<uint8_t> record, ClusterTriangles& plain) {
    record.resize(record.size() + EncodedGrids::recordSlack);
    const auto fast = std::make_unique<ClusterTriangles>();
    decodeClusterPlain(record.data(), plain);
    decodeCluster(record.data(), *fast);
    expectSameDecoded(plain, *fast);
}

}  // namespace

// The target, then the record.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    if (size < 1) return 0;
    static_cast<void>(forceTarget((data[0] & 1) != 0 ? "best" : "scalar").ok());
    const std::span<const uint8_t> bytes(data + 1, size - 1);
    const Result<size_t> length = checkCluster(bytes, UINT32_MAX);
    if (!length) return 0;
    if (*length > bytes.size()) fail("a record is longer than its bytes");
    const auto cluster = std::make_unique<ClusterTriangles>();
    const auto again = std::make_unique<ClusterTriangles>();
    decodeBoth({bytes.begin(), bytes.begin() + static_cast<ptrdiff_t>(*length)}, *cluster);
    const std::vector<uint8_t> record = encodedAnew(*cluster);
    if (const auto sound = checkCluster(record, cluster->triangleCount); !sound || *sound != record.size())
        fail("a record that was written is refused");
    decodeBoth(record, *again);
    for (uint32_t t = 0; t < cluster->triangleCount; ++t) {
        for (size_t k = 0; k < 3; ++k) {
            if (cornerOf(*cluster, k, t) != cornerOf(*again, k, t)) fail("a triangle came back another");
        }
    }
    return 0;
}
