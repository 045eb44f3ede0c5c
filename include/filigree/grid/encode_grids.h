// Grids to records with a hierarchy over them.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/box.h"
#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/grid/encoded_grids.h"
#include "filigree/grid/vertex_grid.h"

#include <cstdint>
#include <vector>

namespace filigree::grid {

// How grids are encoded.
struct EncodeOptions {
    Codec codec = Codec::lattice;

    // Codec::lattice: what vertices are snapped to; every vertex must lie in its range
    // (grid/lattice_choice.h). Codec::paper snaps only clusters, to fineLattice() of the mesh.
    Lattice lattice;

    // Codec::paper.
    DisplacementCode displacement = DisplacementCode::unitVector;
    // Cuts sub-grids further where the surface would crack (docs/spec/paper.md).
    bool snap = false;
};

// Records with the boxes of what they decode to, in the order of the mesh: grids, then clusters.
struct GridRecords {
    Codec codec = Codec::lattice;
    Lattice lattice;
    PaperCode paper;
    std::vector<uint8_t> records;   // without slack
    std::vector<uint32_t> offsets;  // [record_count], as EncodedGrids::offsets
    std::vector<Box> boxes;         // [record_count], lattice coordinates; paper: world units
};

// Encodes `mesh` and brings its loose triangles into the order of the clusters. Codec::paper fails with
// ErrorKind::unsupported where a grid's diagonals differ (ConvertOptions::uniformDiagonals). Both fail with
// ErrorKind::format on a mesh without triangles or vertices outside the lattice, and with ErrorKind::limit
// above 16 GiB of records. The same bytes for any executor. Progress in triangles.
FILIGREE_API Result<GridRecords> encodeRecords(GridMesh& mesh, const EncodeOptions& options,
                                               const Executor& executor = serialExecutor(),
                                               ProgressSink& progress = silentProgress());

// Builds the hierarchy and brings the records into the order of its leaves.
FILIGREE_API EncodedGrids buildGrids(GridRecords records, const Executor& executor);
FILIGREE_API Result<EncodedGrids> buildGrids(GridRecords records, const Executor& executor,
                                             ProgressSink& progress);

// Both.
FILIGREE_API Result<EncodedGrids> encodeGrids(GridMesh& mesh, const EncodeOptions& options,
                                              const Executor& executor = serialExecutor(),
                                              ProgressSink& progress = silentProgress());

// A lattice whose points are floats, so fine that only floats of the greatest size could be finer: steps of
// one power of two. All vertices of the mesh lie in its range. Fails with ErrorKind::format where there are
// none.
FILIGREE_API Result<Lattice> fineLattice(const GridMesh& mesh);

// All that is resident, by what it is for.
struct GridBytes {
    uint64_t geometry = 0;  // records of tiles or sub-grids
    uint64_t bvh = 0;       // nodes, and offsets of records
    uint64_t clusters = 0;
    [[nodiscard]] uint64_t total() const { return geometry + bvh + clusters; }
};
FILIGREE_API GridBytes bytesOf(const EncodedGrids& grids);
FILIGREE_API uint64_t clusterCount(const EncodedGrids& grids);

}  // namespace filigree::grid
