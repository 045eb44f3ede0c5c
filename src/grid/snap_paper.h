// Closes the cracks between sub-grids of the codec `paper` (docs/spec/paper.md, "Cracks").
#pragma once

#include "filigree/core/executor.h"
#include "filigree/grid/lattice.h"
#include "filigree/grid/paper.h"
#include "filigree/grid/vertex_grid.h"

#include <span>
#include <vector>

namespace filigree::grid {

struct SnappedPaper {
    std::vector<PaperPlace> places;
    std::vector<Vec3> vertices;  // what to encode, in the layout of GridMesh::vertices
};

// The sub-grids of `places`, some of them cut further, such that every source position decodes to one point
// in all sub-grids and, on `lattice`, in clusters.
SnappedPaper snapPaper(const GridMesh& mesh, std::span<const PaperPlace> places, const PaperCode& paper,
                       const Lattice& lattice, const Executor& executor);

}  // namespace filigree::grid
