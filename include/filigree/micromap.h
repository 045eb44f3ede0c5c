// Opacity micromaps: states, the order of micro-triangles, quadtrees, and sets of flat micromaps as glTF,
// Vulkan and DXR take them.
//
//     const uint32_t index = micromap::barycentricsToIndex(0.25F, 0.5F, 4);
//     const std::vector<uint8_t> flat(micromap::flatBytes(4, micromap::Format::fourState), 0x55);
//     const auto opaque = micromap::quadtreeFromFlat(flat, 4, micromap::Format::fourState);
//     const bool isOne = micromap::isUniform(opaque.view());
#pragma once

#include "filigree/micromap/buffers.h"
#include "filigree/micromap/curve.h"
#include "filigree/micromap/curve_batch.h"
#include "filigree/micromap/distinct_trees.h"
#include "filigree/micromap/quadtree.h"
#include "filigree/micromap/quadtree_writer.h"
#include "filigree/micromap/set.h"
#include "filigree/micromap/state.h"
#include "filigree/micromap/symmetry.h"
