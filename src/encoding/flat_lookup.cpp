#include "filigree/encoding/flat.h"

#include "encoding/reader_of.h"

#include <cassert>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "encoding/flat_lookup.cpp"
// clang-format off
#include <hwy/foreach_target.h>
#include "encoding/lanes-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace filigree::encoding::HWY_NAMESPACE {

// payload.size() >= 8: states of the last bytes are read from further ahead.
void lookupFlat(const EncodedView& set, const uint32_t* maps, const uint32_t* indices,
                micromap::State* states, size_t count) {
    const Lanes d;
    const bool wide = set.format == micromap::Format::fourState;
    const auto offsetMask = hn::Set(d, 0xffffffff);
    const auto lastLoad = hn::Set(d, set.payload.size() - 8);
    const auto seven = hn::Set(d, 7);
    const auto stateMask = hn::Set(d, wide ? 3 : 1);
    lookupLanes(maps, indices, states, count, [&](LaneVector map, LaneVector index) {
        const auto offset = hn::And(gatherBytes(set.descriptors.data(), hn::ShiftLeft<3>(map)), offsetMask);
        const auto bit = wide ? hn::ShiftLeft<1>(index) : index;
        const auto byte = hn::Add(offset, hn::ShiftRight<3>(bit));
        const auto load = hn::Min(byte, lastLoad);
        const auto shift = hn::Add(hn::ShiftLeft<3>(hn::Sub(byte, load)), hn::And(bit, seven));
        return hn::And(hn::Shr(gatherBytes(set.payload.data(), load), shift), stateMask);
    });
}

}  // namespace filigree::encoding::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace filigree::encoding {

HWY_EXPORT(lookupFlat);

void FlatReader::lookup(std::span<const uint32_t> maps, std::span<const uint32_t> indices,
                        std::span<micromap::State> states) const {
    assert(indices.size() == maps.size() && states.size() == maps.size());
    if (set_.payload.size() >= 8) {
        HWY_DYNAMIC_DISPATCH(lookupFlat)(set_, maps.data(), indices.data(), states.data(), maps.size());
    } else {
        for (size_t k = 0; k < maps.size(); ++k) states[k] = at(maps[k], indices[k]);
    }
}

void FlatReader::lookup(std::span<const uint32_t> maps, std::span<const float> u, std::span<const float> v,
                        std::span<micromap::State> states) const {
    lookupByCurve(*this, maps, u, v, states);
}

}  // namespace filigree::encoding
#endif
