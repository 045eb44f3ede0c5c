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

// [signs][Node::slotAxes]: the turn of a ray.
struct Turns {
    std::array<std::array<uint8_t, 64>, 8> of{};
};
constexpr Turns turnsOfSigns() {
    Turns turns;
    for (unsigned signs = 0; signs < 8; ++signs)
        for (unsigned axes = 0; axes < 64; ++axes)
            for (unsigned bit = 0; bit < 3; ++bit)
                turns.of[signs][axes] |= static_cast<uint8_t>((signs >> (axes >> 2 * bit & 3) & 1) << bit);
    return turns;
}
inline constexpr Turns turns = turnsOfSigns();

// [turn]: the slots, the one that comes first at the end.
struct SlotLists {
    alignas(32) std::array<std::array<int32_t, width>, 8> of{};
};
constexpr SlotLists slotListsOfTurns() {
    SlotLists lists;
    for (size_t turn = 0; turn < 8; ++turn)
        for (size_t k = 0; k < width; ++k) lists.of[turn][k] = static_cast<int32_t>((width - 1 - k) ^ turn);
    return lists;
}
inline constexpr SlotLists slotLists = slotListsOfTurns();

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

// Children [first, first + lanes): where the segment enters and leaves them, and what they are.
struct MetChildren {
    PlaneVector entry, exit;
    hn::VFromD<hn::RebindToUnsigned<Planes>> places;
};

HWY_INLINE MetChildren meetChildren(const Node& node, const Walk& walk, const PlaneTimes& times,
                                    size_t first) {
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
    MetChildren met;
    met.entry = hn::Max(
        hn::Max(times.template near<0>(planes(nearAt[0])), hn::Set(d, walk.tMin)),
        hn::Max(times.template near<1>(planes(nearAt[1])), times.template near<2>(planes(nearAt[2]))));
    met.exit =
        hn::Min(hn::Min(times.template far<0>(planes(farAt[0])), hn::Set(d, walk.tMax)),
                hn::Min(times.template far<1>(planes(farAt[1])), times.template far<2>(planes(farAt[2]))));
    const auto ranks = [&](unsigned mask) HWY_ATTR {
        return hn::PromoteTo(du, hn::LoadU(bytes, slotRanks.of[mask].data() + first));
    };
    const auto leaves = hn::Add(hn::Set(du, node.firstLeaf | Walk::leafBit), ranks(node.leafMask));
    const auto inners = hn::Add(hn::Set(du, node.firstChild), ranks(node.innerMask));
    std::array<uint8_t, 8> leafBits{static_cast<uint8_t>(node.leafMask >> first)};
    met.places = hn::IfThenElse(hn::LoadMaskBits(du, leafBits.data()), leaves, inners);
    // Empty slots have low planes above the high ones, but slack might still let them pass.
    std::array<uint8_t, 8> bits{static_cast<uint8_t>((node.leafMask | node.innerMask) >> first)};
    met.entry = hn::IfThenElse(hn::LoadMaskBits(d, bits.data()), met.entry, hn::Inf(d));
    return met;
}

// Pushes the children that the segment meets, those that come first at the end, or in slot order.
template <bool turning>
HWY_INLINE void visitNode(const Node& node, Walk& walk) {
    const Planes d;
    const hn::RebindToUnsigned<Planes> du;
    const PlaneTimes times(node, walk);
    const auto& slots = turning ? slotLists.of[turns.of[walk.signs][node.slotAxes]] : slotLists.of[width - 1];
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET <= HWY_AVX3
    MetChildren met = meetChildren(node, walk, times, 0);
    if constexpr (turning) {
        const auto order = hn::SetTableIndices(d, slots.data());
        met.entry = hn::TableLookupLanes(met.entry, order);
        met.exit = hn::TableLookupLanes(met.exit, order);
        met.places = hn::TableLookupLanes(met.places, hn::SetTableIndices(du, slots.data()));
    }
    const auto isMet = hn::Le(met.entry, met.exit);
    hn::StoreU(hn::Compress(met.entry, isMet), d, walk.nears.data() + walk.size);
    hn::StoreU(hn::Compress(met.places, hn::RebindMask(du, isMet)), du, walk.places.data() + walk.size);
    walk.size += static_cast<uint32_t>(hn::CountTrue(d, isMet));
#else
    std::array<float, width> entry, exit;
    std::array<uint32_t, width> places;
    for (size_t first = 0; first < width; first += hn::Lanes(d)) {
        const MetChildren met = meetChildren(node, walk, times, first);
        hn::StoreU(met.entry, d, entry.data() + first);
        hn::StoreU(met.exit, d, exit.data() + first);
        hn::StoreU(met.places, du, places.data() + first);
    }
    for (const int32_t slot : slots) {
        const auto k = static_cast<size_t>(slot);
        if (!(entry[k] <= exit[k])) continue;
        walk.nears[walk.size] = entry[k];
        walk.places[walk.size++] = places[k];
    }
#endif
}

// One node on; true where that was the last before a leaf or the end.
template <bool turning>
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
        visitNode<turning>(nodes[place], walk);
        return false;
    }
}

template <bool turning>
void nextLeaf(const Node* nodes, Walk& walk) {
    while (!stepOn<turning>(nodes, walk)) {
    }
}

template <bool turning>
size_t nextLeaves(const Node* nodes, Walk** walks, size_t count, size_t enough) {
    while (count > enough) {
        for (size_t k = 0; k < count;) {
            if (stepOn<turning>(nodes, *walks[k])) {
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
    signs = 0;
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
        signs |= isForward ? 0U : 1U << axis;
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
