// Encoded micromaps in fewer bytes than they need: known parts are given up where that saves most. The model,
// the choice and the search are in docs/spec/lossy.md.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/encoding/encode.h"
#include "filigree/encoding/encoded_set.h"
#include "filigree/micromap/quadtree.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace filigree::encoding {

// A micromap, and how much its quality matters.
struct WeightedMap {
    micromap::QuadtreeView tree;
    double weight = 0;  // world area of the triangles that use it, instances counted, >= 0
};

// Exactly one is given.
struct LossyGoal {
    std::optional<uint64_t> maxBytes;  // payload and descriptors
    std::optional<double> maxCost;     // see LossyPoint, >= 0
};

// One point of the rate curve.
struct LossyPoint {
    uint64_t bytes = 0;  // payload and descriptors, as encoded
    // 4-state: the sum of weight times the share of micro-triangles that are no longer known, which is how
    // many more any-hit calls are expected of rays that hit uniformly by area. 2-state: of those that changed
    // sides.
    double cost = 0;
    double price = 0;  // bits that a unit of cost was held to be worth
};

// What encodeLossy() makes.
struct LossySet {
    EncodedSet set;
    micromap::QuadtreeList maps;   // what it holds, equal ones once
    std::vector<int32_t> indices;  // [map_count], where each of the maps went: into `maps`, or special
    LossyPoint point;
    // By falling bytes and rising cost; the first is lossless.
    std::vector<LossyPoint> curve;
};

// Turns parts of the maps into one unknown leaf each (4-state), or into one leaf of the side that covers more
// of it (2-state), so that the set keeps the goal at about the least cost (maxBytes) or at about the fewest
// bytes (maxCost). No known state is ever wrong with 4-state; leaves take the side of the greater part,
// opaque on a tie. `maps` as encode() takes them, not for Encoding::bitmask. The result does not depend on
// the executor. ErrorKind::limit names the fewest bytes where maxBytes is out of reach; ErrorKind::cancelled.
FILIGREE_API Result<LossySet> encodeLossy(Encoding encoding, std::span<const WeightedMap> maps,
                                          micromap::Format format, const EncodeOptions& options,
                                          const LossyGoal& goal, const Executor& executor,
                                          ProgressSink& progress);

}  // namespace filigree::encoding
