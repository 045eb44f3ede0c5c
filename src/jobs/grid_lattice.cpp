#include "jobs/grid_lattice.h"

#include "filigree/grid/error.h"
#include "filigree/grid/lattice_choice.h"

#include <cmath>

namespace filigree::jobs {
namespace {

Result<ChosenLattice> latticeOrError(const Result<grid::Lattice>& lattice, const char* option,
                                     std::optional<double> paperRms = std::nullopt) {
    if (!lattice) return lattice.error().within(option);
    return ChosenLattice{*lattice, paperRms};
}

// Over all vertices. The paper's codec keeps those of loose triangles as floats.
double paperRms(const grid::GridMesh& mesh, grid::DisplacementCode displacement, const Executor& executor) {
    const grid::VertexErrors errors = grid::paperErrors(mesh, displacement, executor);
    const auto all = static_cast<double>(errors.vertices + mesh.looseVertices.size());
    return errors.rms * std::sqrt(static_cast<double>(errors.vertices) / all);
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
    const double measured = paperRms(mesh, displacement, executor);
    const double rms = measured > 0 ? measured : usualPaperRms * diagonal;
    return latticeOrError(grid::latticeForRms(mesh, rms, executor), "--match-paper", rms);
}

}  // namespace filigree::jobs
