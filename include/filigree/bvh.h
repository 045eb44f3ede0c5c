// An 8-wide compressed hierarchy of boxes: its builder, and a ray's walk from leaf to leaf.
//
//     const std::vector<Box> boxes{{{0, 0, 0}, {1, 1, 1}}, {{2, 0, 0}, {3, 1, 1}}};
//     const Result<bvh::Bvh> tree = bvh::build(boxes, serialExecutor());
#pragma once

#include "filigree/bvh/build.h"
#include "filigree/bvh/node.h"
#include "filigree/bvh/walk.h"
