// Loose triangles as records to trace (docs/spec/cluster.md).
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/executor.h"
#include "filigree/core/result.h"
#include "filigree/grid/lattice.h"
#include "filigree/grid/vertex_grid.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace filigree::grid {

// What one cluster holds at most.
inline constexpr size_t maxClusterTriangles = 64;
inline constexpr size_t maxClusterVertices = 3 * maxClusterTriangles;

// Brings the loose triangles (with their sources) into the order of clusters: neighbours in space and over
// edges stand together. Each triangle may be turned to begin at another of its vertices; its winding stays.
// Returns where each cluster begins and, last, the triangle count: [cluster_count + 1]. The same for any
// executor.
FILIGREE_API std::vector<uint32_t> clusterLoose(GridMesh& mesh, const Executor& executor);

// Appends the record of the `count` loose triangles from `first` on, 1 to maxClusterTriangles, with their
// vertices on `lattice`. Its bytes are a multiple of EncodedGrids::recordUnit. Good for any triangles in any
// order, smallest in the order of clusterLoose.
FILIGREE_API void appendCluster(const GridMesh& mesh, uint32_t first, uint32_t count, const Lattice& lattice,
                                std::vector<uint8_t>& records);

// A decoded record. Arrays are filled up to the counts and unspecified behind them.
struct ClusterTriangles {
    uint32_t firstTriangle = 0;  // into GridMesh::looseTriangles
    uint32_t triangleCount = 0;  // 1 to maxClusterTriangles
    uint32_t vertexCount = 0;    // 1 to maxClusterVertices
    // [axis][vertex], lattice coordinates in [0, latticeLimit).
    alignas(64) std::array<std::array<int32_t, maxClusterVertices>, 3> vertices;
    // [corner][triangle], each below vertexCount.
    alignas(64) std::array<std::array<uint8_t, maxClusterTriangles>, 3> corners;
};

// Checks the record at the start of `bytes` and all that decoding it relies on; triangles must lie below
// `looseCount`. Returns its size in bytes.
FILIGREE_API Result<size_t> checkCluster(std::span<const uint8_t> bytes, uint32_t looseCount);

// Decodes a record that checkCluster accepted, or that appendCluster wrote. May read (and ignore) up to
// EncodedGrids::recordSlack bytes behind it. The first is plain and the judge of the second, which uses the
// machine's vectors.
FILIGREE_API void decodeClusterPlain(const uint8_t* record, ClusterTriangles& out);
FILIGREE_API void decodeCluster(const uint8_t* record, ClusterTriangles& out);

}  // namespace filigree::grid
