// How far decoded vertices lie from their sources.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/executor.h"
#include "filigree/grid/decode_grids.h"
#include "filigree/grid/paper.h"
#include "filigree/grid/vertex_grid.h"

#include <cstdint>
#include <vector>

namespace filigree::grid {

// The box around all vertices, those of loose triangles included; world units.
FILIGREE_API Box boundsOf(const GridMesh& mesh);

// Distances between decoded and source vertices, world units.
struct VertexErrors {
    double rms = 0;
    double max = 0;
    uint64_t vertices = 0;
};

// Errors of a whole mesh.
struct GridErrors {
    VertexErrors all;    // vertices of grids in grid layout, and corners of loose triangles
    VertexErrors grids;  // of grids alone
    // Of each sub-grid of 5 x 5 vertices its largest error against the diagonal of its box, 0..1: the mean
    // and the largest of all sub-grids (table 3 of the paper). Sub-grids of no size do not count.
    double subGridMean = 0;
    double subGridMax = 0;
};
// Of `decoded`, which was made from `mesh`: the same vertices in the same order.
FILIGREE_API GridErrors errorsOf(const GridMesh& mesh, const DecodedGrids& decoded, const Executor& executor);

// The share of errorsOf() of each sub-grid: `columns` x `rows` of them, row by row.
struct SubGridShares {
    uint32_t columns = 0;
    uint32_t rows = 0;
    std::vector<float> shares;
};
FILIGREE_API SubGridShares subGridShares(const GridMesh& mesh, const DecodedGrids& decoded, uint32_t grid);

// What the codec `paper` would come to on the mesh's grids, without keeping its records; whether their
// diagonals agree does not matter. Zero where there are no grids.
FILIGREE_API VertexErrors paperErrors(const GridMesh& mesh, DisplacementCode displacement,
                                      const Executor& executor);

// Positions that several grids, several places of a grid, or loose triangles share and that decode to
// different points: there the surface cracks.
struct Cracks {
    uint64_t shared = 0;   // positions in several places of grids' borders or of loose triangles
    uint64_t cracked = 0;  // of these, so many decode to different points
    double widest = 0;     // the largest distance between two of them, world units
};
FILIGREE_API Cracks cracksOf(const GridMesh& mesh, const DecodedGrids& decoded);

}  // namespace filigree::grid
