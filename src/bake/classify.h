// One triangle to one quadtree.
#pragma once

#include "filigree/core/executor.h"
#include "filigree/mesh/uv_triangle.h"
#include "filigree/micromap/quadtree.h"

#include "bake/field.h"
#include "bake/placement.h"
#include "bake/tile.h"

#include <vector>

namespace filigree::bake {

// A quadtree stream (micromap/quadtree.h) and how many micro-triangles have each state.
struct Classified {
    BitWriter stream;
    micromap::StateCounts states;

    void clear() {
        stream.clear();
        states = {};
    }
    // Appends a leaf of 4^height micro-triangles and returns its state.
    int appendLeaf(unsigned height, int state);
};

// Classifies the micro-triangles of `triangle`, which must be placeable (placement.h), at `level` and appends
// them to `to` as a canonical quadtree. Parts that no outline crosses are decided at once and the rest
// follows the outline. With `twoState`, unknowns become the side that is greater. Large micromaps are worked
// on in parallel.
void classify(const mesh::UvTriangle& triangle, const Field& field, unsigned level, bool twoState,
              const Executor& executor, Classified& to);

}  // namespace filigree::bake
