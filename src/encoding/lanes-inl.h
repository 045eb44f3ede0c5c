// Loops of batched lookups: included once for each SIMD target.
#if defined(FILIGREE_ENCODING_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FILIGREE_ENCODING_LANES_INL_H_
#undef FILIGREE_ENCODING_LANES_INL_H_
#else
#define FILIGREE_ENCODING_LANES_INL_H_
#endif

#include "filigree/micromap/state.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace filigree::encoding::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<uint64_t, 8>;
using LaneVector = hn::VFromD<Lanes>;

// The 8 bytes at base + offsets[lane], at any address.
inline LaneVector gatherBytes(const uint8_t* base, LaneVector offsets) {
    const hn::RebindToSigned<Lanes> signedLanes;
    return hn::GatherOffset(Lanes(), reinterpret_cast<const uint64_t*>(base),
                            hn::BitCast(signedLanes, offsets));
}

// kernel(maps, indices) for one vector.
template <class Kernel>
void lookupVector(const uint32_t* maps, const uint32_t* indices, micromap::State* states, size_t count,
                  const Kernel& kernel) {
    const Lanes d;
    const hn::Rebind<uint32_t, Lanes> narrow;
    const auto found =
        kernel(hn::PromoteTo(d, hn::LoadU(narrow, maps)), hn::PromoteTo(d, hn::LoadU(narrow, indices)));
    std::array<uint64_t, 8> lanes;
    hn::StoreU(found, d, lanes.data());
    for (size_t k = 0; k < count; ++k) states[k] = static_cast<micromap::State>(lanes[k]);
}

// states[k] = kernel(maps, indices) for all k; the last vector is filled up with index 0 of a map in the
// batch.
template <class Kernel>
void lookupLanes(const uint32_t* maps, const uint32_t* indices, micromap::State* states, size_t count,
                 const Kernel& kernel) {
    const size_t lanes = hn::Lanes(Lanes());
    size_t k = 0;
    for (; k + lanes <= count; k += lanes) lookupVector(maps + k, indices + k, states + k, lanes, kernel);
    if (k == count) return;
    std::array<uint32_t, 8> lastMaps;
    std::array<uint32_t, 8> lastIndices{};
    lastMaps.fill(maps[k]);
    std::copy(maps + k, maps + count, lastMaps.begin());
    std::copy(indices + k, indices + count, lastIndices.begin());
    lookupVector(lastMaps.data(), lastIndices.data(), states + k, count - k, kernel);
}

}  // namespace filigree::encoding::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
