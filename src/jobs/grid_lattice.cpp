#include "jobs/grid_lattice.h"

#include "filigree/grid/error.h"

namespace filigree::jobs {
namespace {

Result<ChosenLattice> latticeOrError(const Result<grid::Lattice>& lattice, const char* option) {
    if (!lattice) return lattice.error().within(option);
    return ChosenLattice{*lattice, std::nullopt};
}

}  // namespace

Result<ChosenLattice> chooseLattice(const grid::GridMesh& mesh, const GridPrecision& precision,
                                    grid::DisplacementCode displacement, const Executor& executor) {
    if (precision.lossless) return latticeOrError(grid::losslessLattice(mesh), "--lossless");
    if (precision.maxError) {
        const double share = precision.isShare ? grid::boundsOf(mesh).diagonal() : 1;
        return latticeOrError(grid::latticeForError(mesh, *precision.maxError * share), "--max-error");
    }
    const auto matched = grid::latticeMatchingPaper(mesh, displacement, executor);
    if (!matched) return matched.error().within("--match-paper");
    return ChosenLattice{matched->lattice, matched->rms};
}

}  // namespace filigree::jobs
