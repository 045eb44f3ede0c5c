// What must hold of encoded grids from outside before they are traced.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/grid/encoded_grids.h"
#include "filigree/grid/vertex_grid.h"

#include <cstdint>
#include <span>

namespace filigree::grid {

// Checks what Tracer relies on: lattice, hierarchy, offsets, every record and its slack, and that each leaf's
// box contains the vertices that its record decodes to. Errors name the record. ErrorKind::cancelled;
// progress in records.
FILIGREE_API Status check(const EncodedGrids& grids, const Executor& executor = serialExecutor(),
                          ProgressSink& progress = silentProgress());

// Checks in addition to that, what check() accepted against a table of grids: every quad and each of the
// loose triangles stands in one record.
FILIGREE_API Status checkPlaces(const EncodedGrids& grids, std::span<const VertexGrid> table,
                                uint32_t looseTriangles);

}  // namespace filigree::grid
