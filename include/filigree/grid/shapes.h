// Displaced surfaces made in code, the same to the bit on every machine: what benches, tests and the demo
// work on.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/executor.h"
#include "filigree/grid/vertex_grid.h"

#include <cstdint>

namespace filigree::grid {

// Hills with ridges: one grid of n x n vertices over x and z in [0, 1], heights along y, facing up. n is at
// least 2. Exact x and z where n - 1 is a power of two.
FILIGREE_API GridMesh terrain(uint32_t n, const Executor& executor);

// A closed, displaced torus about the y axis, radii 1 and 0.4: one grid of n x n vertices, of which the last
// column and row repeat the first to the bit; facing outwards. n is at least 4.
FILIGREE_API GridMesh torus(uint32_t n, const Executor& executor);

// A closed, displaced box about [-1, 1]^3 of `side` quads along each edge, facing outwards, made of four
// grids: top, bottom, and a belt about the sides cut in two at places that are not its corners. Where grids
// meet, their vertices are equal to the bit, but the grids run in different directions, begin at different
// phases, and one has the other diagonal. `side` is at least 8.
FILIGREE_API GridMesh box(uint32_t side, const Executor& executor);

}  // namespace filigree::grid
