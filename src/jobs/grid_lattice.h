// The lattice of a mesh after what the user asks for.
#pragma once

#include "filigree/core/executor.h"
#include "filigree/core/result.h"
#include "filigree/grid/lattice_choice.h"
#include "filigree/grid/paper.h"
#include "filigree/grid/vertex_grid.h"
#include "filigree/jobs/grids.h"

#include <optional>

namespace filigree::jobs {

struct ChosenLattice {
    grid::Lattice lattice;
    std::optional<double> paperRms;  // where it was matched, world units
};

using grid::usualPaperRms;

// Errors name the option.
Result<ChosenLattice> chooseLattice(const grid::GridMesh& mesh, const GridPrecision& precision,
                                    grid::DisplacementCode displacement, const Executor& executor);

}  // namespace filigree::jobs
