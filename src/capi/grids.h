// The handle of compressed grids.
#pragma once

#include "filigree/io/fil_grids.h"

#include "capi/memory.h"
#include "filigree.h"

#include <cstdint>

struct filigree_grids {
    filigree::capi::Memory memory;
    filigree::io::FilGrids file;  // grids, their table and attributes
    double rmsError = -1;         // world units; -1: not measured
    double maxError = -1;
};

namespace filigree::capi {

// The number of a hit triangle in the source, or among filigree_grids_get_triangles() where sources were not
// kept.
uint32_t sourceOf(const filigree_grids& grids, const grid::Hit& hit);

}  // namespace filigree::capi
