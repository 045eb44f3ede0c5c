// Which lattice a mesh is snapped to: from the error that is allowed.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/grid/lattice.h"
#include "filigree/grid/paper.h"
#include "filigree/grid/vertex_grid.h"

namespace filigree::grid {

// All three take one step for the axes on which vertices lie anywhere. An axis on which all of them lie on a
// regular spacing takes that for its step where it is not finer, or where coordinates grow evenly along the
// grids (x and z of a heightfield): such an axis is exact and takes no bits. All vertices lie in the
// lattice's range, those of loose triangles included.
//
// Rounding: on each axis a decoded vertex lies within step / 2 + 2^-22 m of its source, where m is the axis's
// greatest absolute coordinate; the second term is what floats cannot hold.
//
// All fail with ErrorKind::format where there are no vertices or one is not finite, and with ErrorKind::limit
// where coordinates would reach 2^24: the message says which step fits.

// No vertex lies further than `maxError`, world units, from its source, but for rounding: with n axes of the
// one step s, sqrt(n) s / 2 is `maxError`. Fails with ErrorKind::usage unless it is positive and at most the
// diagonal of the mesh's box.
FILIGREE_API Result<Lattice> latticeForError(const GridMesh& mesh, double maxError);

// The root mean square distance of the vertices of grids (of loose triangles, where there are no grids) is
// measured to be `rms`, world units, or up to 0.5 % less; it may be far less where all axes are regular.
// Fails with ErrorKind::usage like latticeForError.
FILIGREE_API Result<Lattice> latticeForRms(const GridMesh& mesh, double rms,
                                           const Executor& executor = serialExecutor(),
                                           ProgressSink& progress = silentProgress());

// positionOf(pointAt(v)) is v, to the bit, for every vertex: heightfields, quantised meshes. Fails with
// ErrorKind::unsupported, naming a vertex, where there is no such lattice.
FILIGREE_API Result<Lattice> losslessLattice(const GridMesh& mesh);

// As latticeForRms, of the paper's codec: its sub-grids on the same grids, over all vertices, with no error
// at those of loose triangles, which it keeps as floats.
struct MatchedLattice {
    Lattice lattice;
    double rms = 0;  // that is matched, world units
};
FILIGREE_API Result<MatchedLattice> latticeMatchingPaper(const GridMesh& mesh, DisplacementCode displacement,
                                                         const Executor& executor);

// Where the paper's codec has no error on the mesh, or there are no grids, its share of the diagonal is taken
// to be this, which is what it is on ordinary displaced surfaces.
inline constexpr double usualPaperRms = 1e-5;

}  // namespace filigree::grid
