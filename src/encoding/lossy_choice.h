// The choice at each node: what is below it, or one leaf.
#pragma once

#include "encoding/lossy_prune.h"

#include <algorithm>

namespace filigree::encoding {

// A node with all that is kept below it. Counts are of micro-triangles.
struct Kept {
    double bits = 0;
    uint64_t lost = 0;    // given up so far
    uint64_t known = 0;   // of the map as it was
    uint64_t opaque = 0;  // likewise, on the opaque side
    int leaf = -1;        // the state where all of it is one leaf

    void add(const Kept& child) {
        bits += child.bits;
        lost += child.lost;
        known += child.known;
        opaque += child.opaque;
    }
};

inline Kept keptLeaf(micromap::State state, unsigned height, double bits) {
    const uint64_t count = micromap::microTriangleCount(height);
    return {bits, 0, micromap::isKnown(state) ? count : 0, micromap::isOpaqueSide(state) ? count : 0,
            static_cast<int>(state)};
}

// `kept` as one leaf of `bits`, of the side that covers more.
inline Kept asLeaf(const Kept& kept, unsigned height, double bits, micromap::Format format) {
    const uint64_t count = micromap::microTriangleCount(height);
    const bool opaque = 2 * kept.opaque >= count;
    Kept leaf = kept;
    leaf.bits = bits;
    if (format == micromap::Format::twoState) {
        leaf.lost = std::min(kept.opaque, count - kept.opaque);
        leaf.leaf = static_cast<int>(micromap::knownOf(opaque));
    } else {
        leaf.lost = kept.known;
        leaf.leaf = static_cast<int>(micromap::unknownOf(opaque));
    }
    return leaf;
}

inline double costOf(const WeightedMap& map, uint64_t lost) {
    return map.weight * static_cast<double>(lost) /
           static_cast<double>(micromap::microTriangleCount(map.tree.level));
}

// True when the leaf saves bits that are worth what it loses more, at `price` bits a micro-triangle.
inline bool pays(const Kept& leaf, const Kept& kept, double price) {
    if (leaf.bits >= kept.bits) return false;
    if (leaf.lost <= kept.lost) return true;
    return static_cast<double>(leaf.lost - kept.lost) * price < kept.bits - leaf.bits;
}

}  // namespace filigree::encoding
