// The way of one ray through a hierarchy, near leaves first.
#pragma once

#include "filigree/bvh/build.h"
#include "filigree/bvh/node.h"
#include "filigree/core/api.h"
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
};

// By this share of the largest coordinates of boxes and origin on an axis, boxes count as wider on it: no
// box is missed for rounding (Ize 2013), and no triangle in it that a watertight test in floats would hit.
inline constexpr float walkSlack = 0x1p-19F;

// No box under the root has greater coordinates, but for the last steps of its lattice.
FILIGREE_API Vec3 largestCoordinates(const Node& root);

// Where a ray has got to. After a call of NextLeaf or NextLeaves `leaf` says what to test; where that finds a
// hit, lower tMax before the next call.
class FILIGREE_API Walk {
  public:
    // `largest`: largestCoordinates() of the first node.
    void start(const Segment& segment, const Vec3& largest);

    uint32_t leaf = 0;  // noLeaf at the end
    float tMax = 0;

    // For this room.
    static constexpr uint32_t leafBit = 0x80000000;
    // Vectors of eight are written at the top.
    static constexpr size_t stackSize = maxDepth * (width - 1) + 1 + width;

    alignas(16) std::array<float, 4> nearOrigin{};  // widened
    alignas(16) std::array<float, 4> farOrigin{};
    alignas(16) std::array<float, 4> reciprocal{};  // of the direction
    std::array<uint32_t, 3> nearPlanes{};           // where in a node the near planes' bytes are
    std::array<uint32_t, 3> farPlanes{};
    float tMin = 0;
    uint32_t signs = 0;  // bit k: the direction is negative on axis k
    uint32_t size = 0;   // of the stack
    std::array<float, stackSize> nears;
    std::array<uint32_t, stackSize> places;  // a node, or leafBit and a leaf
};

// What Walk::leaf says at the end of the way.
inline constexpr uint32_t noLeaf = 0xffffffff;

// For the instruction set in use (core/target.h); all take the same way. `nodes` must have passed check().
struct WalkFunctions {
    // Goes on to the next leaf whose box the segment may meet.
    void (*nextLeaf)(const Node* nodes, Walk& walk) = nullptr;

    // Takes `count` walks on by turns, so that one computes while others wait, until no more than `enough`
    // still walk. They come first then; returns how many. Those that have found a leaf or their end follow.
    size_t (*nextLeaves)(const Node* nodes, Walk** walks, size_t count, size_t enough) = nullptr;
};
enum class WalkOrder : uint8_t {
    near,  // near children first
    any,   // cheaper; for rays that end at their first hit
};
WalkFunctions walkFunctions(WalkOrder order);

}  // namespace filigree::bvh
