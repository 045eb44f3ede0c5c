#include "jobs/grid_lattice.h"

#include "filigree/grid/error.h"
#include "filigree/grid/lattice_choice.h"

namespace filigree::jobs {
namespace {

Result<ChosenLattice> latticeOrError(const Result<grid::Lattice>& lattice, const char* option,
                                     std::optional<double> paperRms = std::nullopt) {
    if (!lattice) return lattice.error().within(option);
    return ChosenLattice{*lattice, paperRms};
}

}  // namespace

Result<ChosenLattice> chooseLattice(const grid::GridMesh& mesh, const GridPrecision& precision,
                                    grid::DisplacementCode displacement, const Executor& executor) {
    if (precision.lossless) return latticeOrError(grid::losslessLattice(mesh), "--lossless");
    const double diagonal = grid::boundsOf(mesh).diagonal();
    if (precision.maxError) {
        const double error = *precision.maxError * (precision.isShare ? diagonal : 1);
        return latticeOrError(grid::latticeForError(mesh, error), "--max-error");
    }
    double rms = grid::paperErrors(mesh, displacement, executor).rms;
    if (!(rms > 0)) rms = usualPaperRms * diagonal;
    return latticeOrError(grid::latticeForRms(mesh, rms, executor), "--match-paper", rms);
}

}  // namespace filigree::jobs
