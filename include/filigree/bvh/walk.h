// The way of one ray through a hierarchy, nearest leaves first.
#pragma once

#include "filigree/bvh/build.h"
#include "filigree/bvh/node.h"
#include "filigree/core/vec3.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace filigree::bvh {

// Points origin + t * direction with tMin <= t <= tMax, in the nodes' coordinates. The largest component of
// the direction is at least 1 and below 2; coordinates and origin lie below 2^60.
struct Segment {
    Vec3 origin{};
    Vec3 direction{};
    float tMin = 0;
    float tMax = 0;
    // Boxes count as wider by this on every side: as much as the test of what lies in them may err.
    float slack = 0;
};

// Give it to NextLeaf until there are no more leaves; where a hit is found, lower tMax before the next call.
class Walk {
  public:
    explicit Walk() = default;
    void start(const Segment& segment);

    float tMax = 0;

    // For NextLeaf.
    struct Entry {
        float near;
        uint32_t place;  // a node, or leafBit and a leaf
    };
    static constexpr uint32_t leafBit = 0x80000000;
    static constexpr size_t stackSize = maxDepth * (width - 1) + 1;

    Vec3 origin{};
    Vec3 reciprocal{};                     // of the direction
    Vec3 slack{};                          // in t
    std::array<uint32_t, 3> nearPlanes{};  // where in a node the near planes' bytes are
    std::array<uint32_t, 3> farPlanes{};
    float tMin = 0;
    size_t size = 0;
    std::array<Entry, stackSize> stack;
};

// Goes on to the next leaf whose box the segment may meet, and gives its number; none are left where it
// returns noLeaf. Boxes are not missed for rounding (Ize 2013). `nodes` must have passed check().
inline constexpr uint32_t noLeaf = 0xffffffff;
using NextLeaf = uint32_t (*)(const Node* nodes, Walk& walk);

// For the instruction set in use (core/target.h); all take the same way.
NextLeaf nextLeafFunction();

}  // namespace filigree::bvh
