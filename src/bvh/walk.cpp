#include "filigree/bvh/walk.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <utility>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bvh/walk.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef FILIGREE_BVH_WALK
#define FILIGREE_BVH_WALK
namespace filigree::bvh {

inline unsigned leafMaskOf(const Node& node) {
    uint64_t kinds = 0;
    std::memcpy(&kinds, node.meta.data(), sizeof(kinds));
    if constexpr (std::endian::native == std::endian::little)
        return static_cast<unsigned>(kinds * 0x0102040810204080 >> 56);
    return node.leafMask();
}

// [mask][slot]: bits of the mask below the slot.
struct SlotRanks {
    std::array<std::array<uint8_t, width>, 256> of{};
};
constexpr SlotRanks slotRanksOfMasks() {
    SlotRanks ranks;
    for (unsigned mask = 0; mask < 256; ++mask)
        for (unsigned slot = 0; slot < width; ++slot)
            ranks.of[mask][slot] = static_cast<uint8_t>(std::popcount(mask & ((1U << slot) - 1)));
    return ranks;
}
inline constexpr SlotRanks slotRanks = slotRanksOfMasks();

// Like sortTop, without a branch: which is nearer cannot be foretold.
inline void sortTwo(Walk& walk) {
    float* const nears = walk.nears.data() + walk.size - 2;
    uint32_t* const places = walk.places.data() + walk.size - 2;
    const float nearA = nears[0], nearB = nears[1];
    const uint32_t placeA = places[0], placeB = places[1];
    const bool swaps = nearA <= nearB;
    nears[0] = swaps ? nearB : nearA;
    nears[1] = swaps ? nearA : nearB;
    places[0] = swaps ? placeB : placeA;
    places[1] = swaps ? placeA : placeB;
}

// The last `count` entries of the stack, which stand in slot order: the nearest comes last, of equal ones the
// first slot.
inline void sortTop(Walk& walk, uint32_t count) {
    float* const nears = walk.nears.data() + walk.size - count;
    uint32_t* const places = walk.places.data() + walk.size - count;
    for (uint32_t k = 1; k < count; ++k) {
        const float near = nears[k];
        const uint32_t place = places[k];
        uint32_t at = k;
        for (; at > 0 && nears[at - 1] <= near; --at) {
            nears[at] = nears[at - 1];
            places[at] = places[at - 1];
        }
        nears[at] = near;
        places[at] = place;
    }
}

}  // namespace filigree::bvh
#endif

HWY_BEFORE_NAMESPACE();
namespace filigree::bvh::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Planes = hn::CappedTag<float, width>;
using PlaneVector = hn::VFromD<Planes>;

// Of one node: t of plane q of an axis is scale * q + near or far. Lanes 0 to 2 are the axes, in every block
// of four lanes.
#if HWY_TARGET == HWY_SCALAR
class PlaneTimes {
  public:
    PlaneTimes(const Node& node, const Walk& walk) {
        for (size_t k = 0; k < 3; ++k) {
            const float step = std::bit_cast<float>(static_cast<uint32_t>(node.exponent[k] + 127) << 23);
            scale_[k] = step * walk.reciprocal[k];
            near_[k] = (node.origin[k] - walk.nearOrigin[k]) * walk.reciprocal[k];
            far_[k] = (node.origin[k] - walk.farOrigin[k]) * walk.reciprocal[k];
        }
    }
    template <int axis>
    PlaneVector near(PlaneVector planes) const {
        const Planes d;
        return hn::Add(hn::Mul(planes, hn::Set(d, scale_[axis])), hn::Set(d, near_[axis]));
    }
    template <int axis>
    PlaneVector far(PlaneVector planes) const {
        const Planes d;
        return hn::Add(hn::Mul(planes, hn::Set(d, scale_[axis])), hn::Set(d, far_[axis]));
    }

  private:
    std::array<float, 3> scale_, near_, far_;
};
#else
class PlaneTimes {
  public:
    HWY_INLINE PlaneTimes(const Node& node, const Walk& walk) {
        const Planes d;
        const hn::RebindToSigned<Planes> di;
        const hn::Repartition<uint8_t, Planes> bytes;
        // The fourth lane holds the exponents and a mask.
        const auto origin = hn::LoadDup128(d, node.origin.data());
        // Each exponent to the top byte of its lane, and from there to where floats have theirs.
        alignas(16) static constexpr std::array<uint8_t, 16> spread{
            0x80, 0x80, 0x80, 12, 0x80, 0x80, 0x80, 13, 0x80, 0x80, 0x80, 14, 0x80, 0x80, 0x80, 0x80};
        const auto tops =
            hn::TableLookupBytesOr0(hn::BitCast(bytes, origin), hn::LoadDup128(bytes, spread.data()));
        const auto exponents = hn::ShiftRight<1>(hn::BitCast(di, tops));
        const auto step = hn::BitCast(d, hn::Add(exponents, hn::Set(di, 127 << 23)));
        const auto reciprocal = hn::LoadDup128(d, walk.reciprocal.data());
        scale_ = hn::Mul(step, reciprocal);
        near_ = hn::Mul(hn::Sub(origin, hn::LoadDup128(d, walk.nearOrigin.data())), reciprocal);
        far_ = hn::Mul(hn::Sub(origin, hn::LoadDup128(d, walk.farOrigin.data())), reciprocal);
    }
    template <int axis>
    HWY_INLINE PlaneVector near(PlaneVector planes) const {
        return hn::Add(hn::Mul(planes, hn::Broadcast<axis>(scale_)), hn::Broadcast<axis>(near_));
    }
    template <int axis>
    HWY_INLINE PlaneVector far(PlaneVector planes) const {
        return hn::Add(hn::Mul(planes, hn::Broadcast<axis>(scale_)), hn::Broadcast<axis>(far_));
    }

  private:
    PlaneVector scale_, near_, far_;
};
#endif

// Pushes the children [first, first + lanes) that the segment meets, in slot order.
HWY_INLINE void pushChildren(const Node& node, Walk& walk, const PlaneTimes& times, size_t first,
                             unsigned leafMask) {
    const Planes d;
    const hn::RebindToSigned<Planes> di;
    const hn::RebindToUnsigned<Planes> du;
    const hn::Rebind<uint8_t, Planes> bytes;
    const auto* base = reinterpret_cast<const uint8_t*>(&node) + first;
    const auto planes = [&](uint32_t at) HWY_ATTR {
        return hn::ConvertTo(d, hn::PromoteTo(di, hn::LoadU(bytes, base + at)));
    };
    const auto& nearAt = walk.nearPlanes;
    const auto& farAt = walk.farPlanes;
    const auto entry = hn::Max(
        hn::Max(times.template near<0>(planes(nearAt[0])), hn::Set(d, walk.tMin)),
        hn::Max(times.template near<1>(planes(nearAt[1])), times.template near<2>(planes(nearAt[2]))));
    const auto exit =
        hn::Min(hn::Min(times.template far<0>(planes(farAt[0])), hn::Set(d, walk.tMax)),
                hn::Min(times.template far<1>(planes(farAt[1])), times.template far<2>(planes(farAt[2]))));
    const auto ranks = [&](unsigned mask) HWY_ATTR {
        return hn::PromoteTo(du, hn::LoadU(bytes, slotRanks.of[mask].data() + first));
    };
    const auto leaves = hn::Add(hn::Set(du, node.firstLeaf | Walk::leafBit), ranks(leafMask));
    const auto inners = hn::Add(hn::Set(du, node.firstChild), ranks(node.innerMask));
    const auto isLeaf = hn::Ne(hn::PromoteTo(du, hn::LoadU(bytes, node.meta.data() + first)), hn::Zero(du));
    const auto places = hn::IfThenElse(isLeaf, leaves, inners);
    // Empty slots have low planes above the high ones, but slack might still let them pass.
    std::array<uint8_t, 8> bits{static_cast<uint8_t>((leafMask | node.innerMask) >> first)};
    const auto met = hn::And(hn::Le(entry, exit), hn::LoadMaskBits(d, bits.data()));
    hn::StoreU(hn::Compress(entry, met), d, walk.nears.data() + walk.size);
    hn::StoreU(hn::Compress(places, hn::RebindMask(du, met)), du, walk.places.data() + walk.size);
    walk.size += static_cast<uint32_t>(hn::CountTrue(d, met));
}

template <bool sorts>
HWY_INLINE void visitNode(const Node& node, Walk& walk) {
    const PlaneTimes times(node, walk);
    const unsigned leafMask = leafMaskOf(node);
    const uint32_t before = walk.size;
    for (size_t first = 0; first < width; first += hn::Lanes(Planes())) {
        pushChildren(node, walk, times, first, leafMask);
    }
    if constexpr (!sorts) return;
    const uint32_t count = walk.size - before;
    if (count == 2) {
        sortTwo(walk);
    } else if (count > 2) {
        sortTop(walk, count);
    }
}

// One node on; true where that was the last before a leaf or the end.
template <bool sorts>
HWY_INLINE bool stepOn(const Node* nodes, Walk& walk) {
    for (;;) {
        if (walk.size == 0) {
            walk.leaf = noLeaf;
            return true;
        }
        const uint32_t top = --walk.size;
        if (walk.nears[top] > walk.tMax) continue;
        const uint32_t place = walk.places[top];
        if ((place & Walk::leafBit) != 0) {
            walk.leaf = place & ~Walk::leafBit;
            return true;
        }
        visitNode<sorts>(nodes[place], walk);
        return false;
    }
}

template <bool sorts>
void nextLeaf(const Node* nodes, Walk& walk) {
    while (!stepOn<sorts>(nodes, walk)) {
    }
}

template <bool sorts>
size_t nextLeaves(const Node* nodes, Walk** walks, size_t count, size_t enough) {
    while (count > enough) {
        for (size_t k = 0; k < count;) {
            if (stepOn<sorts>(nodes, *walks[k])) {
                std::swap(walks[k], walks[--count]);
            } else {
                ++k;
            }
        }
    }
    return count;
}

WalkFunctions walkFunctionsHere(WalkOrder order) {
    if (order == WalkOrder::any) return {&nextLeaf<false>, &nextLeaves<false>};
    return {&nextLeaf<true>, &nextLeaves<true>};
}

}  // namespace filigree::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace filigree::bvh {

HWY_EXPORT(walkFunctionsHere);

Vec3 largestCoordinates(const Node& root) {
    Vec3 largest{};
    for (size_t axis = 0; axis < 3; ++axis) {
        const float far = root.origin[axis] + std::ldexp(255.0F, root.exponent[axis]);
        largest[axis] = std::max(std::abs(root.origin[axis]), std::abs(far));
    }
    return largest;
}

void Walk::start(const Segment& segment, const Vec3& largest) {
    // Directions that hardly leave a plane: finite all the same, and with the slack never out of a slab that
    // the origin is in.
    constexpr float steepest = 0x1p60F;
    const auto planeOf = [](bool low, size_t axis) {
        return static_cast<uint32_t>((low ? offsetof(Node, low) : offsetof(Node, high)) + width * axis);
    };
    for (size_t axis = 0; axis < 3; ++axis) {
        const float along = segment.direction[axis];
        const bool isFlat = std::abs(along) < 1 / steepest;
        reciprocal[axis] = isFlat ? std::copysign(steepest, along) : 1 / along;
        const float slack =
            std::copysign(walkSlack * (largest[axis] + std::abs(segment.origin[axis])), reciprocal[axis]);
        nearOrigin[axis] = segment.origin[axis] + slack;
        farOrigin[axis] = segment.origin[axis] - slack;
        const bool isForward = reciprocal[axis] > 0;
        nearPlanes[axis] = planeOf(isForward, axis);
        farPlanes[axis] = planeOf(!isForward, axis);
    }
    tMin = segment.tMin;
    tMax = segment.tMax;
    nears[0] = tMin;
    places[0] = 0;
    size = 1;
}

WalkFunctions walkFunctions(WalkOrder order) {
    return HWY_DYNAMIC_DISPATCH(walkFunctionsHere)(order);
}

}  // namespace filigree::bvh
#endif
