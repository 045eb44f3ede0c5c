#include "filigree/bvh/walk.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bvh/walk.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef FILIGREE_BVH_WALK
#define FILIGREE_BVH_WALK
namespace filigree::bvh {

// Of (origin - o) * r + q * 2^e * r, per axis: three roundings of the first product, two of the second, one
// of the sum and what rounds the bound itself, each 2^-24 of what is rounded.
constexpr float planeError = 8 * 0x1p-24F;

inline unsigned leafMaskOf(const Node& node) {
    uint64_t kinds = 0;
    std::memcpy(&kinds, node.meta.data(), sizeof(kinds));
    if constexpr (std::endian::native == std::endian::little)
        return static_cast<unsigned>(kinds * 0x0102040810204080 >> 56);
    return node.leafMask();
}

// Pushes so that the nearest comes off first, of equal ones the first slot.
class NearestFirst {
  public:
    explicit NearestFirst(Walk& walk) : stack_(walk.stack.data() + walk.size), walk_(walk) {}
    ~NearestFirst() { walk_.size += count_; }
    NearestFirst(const NearestFirst&) = delete;
    NearestFirst& operator=(const NearestFirst&) = delete;

    void add(float near, uint32_t place) {
        size_t at = count_++;
        for (; at > 0 && stack_[at - 1].near <= near; --at) stack_[at] = stack_[at - 1];
        stack_[at] = {near, place};
    }

  private:
    Walk::Entry* stack_;
    Walk& walk_;
    size_t count_ = 0;
};

}  // namespace filigree::bvh
#endif

HWY_BEFORE_NAMESPACE();
namespace filigree::bvh::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Planes = hn::CappedTag<float, width>;

// t of plane q of a node's axis is scale * q + offset, less or more `error`.
struct PlaneTimes {
    std::array<float, 3> scale;
    std::array<float, 3> nearOffset;
    std::array<float, 3> farOffset;
};

inline PlaneTimes planeTimes(const Node& node, const Walk& walk) {
    PlaneTimes times;
    for (size_t k = 0; k < 3; ++k) {
        const float step = std::bit_cast<float>(static_cast<uint32_t>(node.exponent[k] + 127) << 23);
        const float scale = step * walk.reciprocal[k];
        const float offset = (node.origin[k] - walk.origin[k]) * walk.reciprocal[k];
        const float error = (std::abs(offset) + std::abs(scale) * 255.0F) * planeError + walk.slack[k];
        times.scale[k] = scale;
        times.nearOffset[k] = offset - error;
        times.farOffset[k] = offset + error;
    }
    return times;
}

// The children [first, first + lanes): when the segment enters them, and which it meets as bits.
inline unsigned enteredChildren(const Node& node, const Walk& walk, const PlaneTimes& times, size_t first,
                                float* near) {
    const Planes d;
    const hn::RebindToSigned<Planes> di;
    const hn::Rebind<uint8_t, Planes> bytes;
    const auto* base = reinterpret_cast<const uint8_t*>(&node) + first;
    const auto planes = [&](uint32_t at) {
        return hn::ConvertTo(d, hn::PromoteTo(di, hn::LoadU(bytes, base + at)));
    };
    auto entry = hn::Set(d, walk.tMin);
    auto exit = hn::Set(d, walk.tMax);
    for (size_t axis = 0; axis < 3; ++axis) {
        const auto scale = hn::Set(d, times.scale[axis]);
        entry = hn::Max(entry, hn::Add(hn::Mul(planes(walk.nearPlanes[axis]), scale),
                                       hn::Set(d, times.nearOffset[axis])));
        exit = hn::Min(
            exit, hn::Add(hn::Mul(planes(walk.farPlanes[axis]), scale), hn::Set(d, times.farOffset[axis])));
    }
    hn::StoreU(entry, d, near + first);
    std::array<uint8_t, 8> bits{};
    hn::StoreMaskBits(d, hn::Le(entry, exit), bits.data());
    return static_cast<unsigned>(bits[0]) << first;
}

inline void visitNode(const Node& node, Walk& walk) {
    const PlaneTimes times = planeTimes(node, walk);
    alignas(64) std::array<float, width> near;
    const unsigned leafMask = leafMaskOf(node);
    unsigned met = 0;
    for (size_t first = 0; first < width; first += hn::Lanes(Planes())) {
        met |= enteredChildren(node, walk, times, first, near.data());
    }
    met &= leafMask | node.innerMask;
    NearestFirst order(walk);
    for (; met != 0; met &= met - 1) {
        const auto slot = static_cast<unsigned>(std::countr_zero(met));
        const unsigned below = (1U << slot) - 1;
        const bool isLeaf = (leafMask >> slot & 1) != 0;
        const auto rank = static_cast<uint32_t>(std::popcount((isLeaf ? leafMask : node.innerMask) & below));
        order.add(near[slot], isLeaf ? Walk::leafBit | (node.firstLeaf + rank) : node.firstChild + rank);
    }
}

uint32_t nextLeaf(const Node* nodes, Walk& walk) {
    while (walk.size > 0) {
        const Walk::Entry entry = walk.stack[--walk.size];
        if (entry.near > walk.tMax) continue;
        if ((entry.place & Walk::leafBit) != 0) return entry.place & ~Walk::leafBit;
        visitNode(nodes[entry.place], walk);
    }
    return noLeaf;
}

NextLeaf nextLeafHere() {
    return &nextLeaf;
}

}  // namespace filigree::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace filigree::bvh {

HWY_EXPORT(nextLeafHere);

void Walk::start(const Segment& segment) {
    // Directions that hardly leave a plane: finite all the same, and with the slack never out of a slab that
    // the origin is in.
    constexpr float steepest = 0x1p60F;
    for (size_t axis = 0; axis < 3; ++axis) {
        const float along = segment.direction[axis];
        const bool isFlat = std::abs(along) < 1 / steepest;
        const float reciprocalHere = isFlat ? std::copysign(steepest, along) : 1 / along;
        const bool forward = reciprocalHere > 0;
        origin[axis] = segment.origin[axis];
        reciprocal[axis] = reciprocalHere;
        slack[axis] = segment.slack * std::abs(reciprocalHere);
        nearPlanes[axis] =
            static_cast<uint32_t>((forward ? offsetof(Node, low) : offsetof(Node, high)) + width * axis);
        farPlanes[axis] =
            static_cast<uint32_t>((forward ? offsetof(Node, high) : offsetof(Node, low)) + width * axis);
    }
    tMin = segment.tMin;
    tMax = segment.tMax;
    stack[0] = {tMin, 0};
    size = 1;
}

NextLeaf nextLeafFunction() {
    return HWY_DYNAMIC_DISPATCH(nextLeafHere)();
}

}  // namespace filigree::bvh
#endif
