#include "filigree/encoding/dag.h"

#include "encoding/dag_layout.h"
#include "encoding/reader_of.h"

#include <array>
#include <cassert>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "encoding/dag_lookup.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace filigree::encoding::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using WordLanes = hn::CappedTag<uint32_t, 16>;
using WordVector = hn::VFromD<WordLanes>;

inline WordVector gatherWords(const uint32_t* words, WordVector at) {
    const WordLanes d;
    return hn::GatherIndex(d, words, hn::BitCast(hn::RebindToSigned<WordLanes>(), at));
}

// DagReader::at() in each lane. Lanes that have arrived, or found nothing, look at their node again.
inline WordVector lookupDagLanes(const EncodedView& set, WordVector maps, WordVector indices) {
    const WordLanes d;
    const auto* words = reinterpret_cast<const uint32_t*>(set.payload.data());
    const bool wide = set.format == micromap::Format::fourState;
    const auto one = hn::Set(d, 1);
    const auto four = hn::Set(d, 4);
    const auto descriptors = gatherWords(reinterpret_cast<const uint32_t*>(set.descriptors.data()), maps);
    const auto pairs = hn::ShiftRight<1>(hn::Add(hn::ShiftRight<28>(descriptors), one));
    auto shift = hn::ShiftLeft<2>(hn::Sub(hn::Max(pairs, hn::Set(d, 2)), one));
    auto node = hn::And(descriptors, hn::Set(d, (1u << 28) - 1));
    for (;;) {
        const auto head = gatherWords(words, node);
        const auto child = hn::Shl(one, hn::And(hn::Shr(indices, shift), hn::Set(d, 15)));
        const auto present = hn::Ne(hn::And(head, child), hn::Zero(d));
        const auto rank = hn::PopulationCount(hn::And(head, hn::Sub(child, one)));
        const auto inner = hn::And(present, hn::Gt(shift, four));
        if (hn::AllFalse(d, inner)) {
            const auto state = hn::Add(hn::ShiftLeft<4>(rank), hn::And(indices, hn::Set(d, 15)));
            const auto bit = wide ? hn::ShiftLeft<1>(state) : state;
            const auto at = hn::Add(hn::Add(node, one), hn::ShiftRight<5>(bit));
            const auto mask = gatherWords(words, hn::IfThenElse(present, at, node));
            const auto found = hn::And(hn::Shr(mask, hn::And(bit, hn::Set(d, 31))), hn::Set(d, wide ? 3 : 1));
            return hn::IfThenElseZero(present, found);
        }
        const auto pointer = hn::Add(node, hn::IfThenElseZero(inner, hn::Add(rank, one)));
        node = hn::IfThenElse(inner, gatherWords(words, pointer), node);
        shift = hn::IfThenElse(inner, hn::Sub(shift, four), shift);
    }
}

void lookupDag(const EncodedView& set, const uint32_t* maps, const uint32_t* indices, micromap::State* states,
               size_t count) {
    const WordLanes d;
    const hn::Rebind<uint8_t, WordLanes> bytes;
    const size_t lanes = hn::Lanes(d);
    auto* to = reinterpret_cast<uint8_t*>(states);
    size_t k = 0;
    for (; k + lanes <= count; k += lanes) {
        const auto found = lookupDagLanes(set, hn::LoadU(d, maps + k), hn::LoadU(d, indices + k));
        hn::StoreU(hn::DemoteTo(bytes, hn::BitCast(hn::RebindToSigned<WordLanes>(), found)), bytes, to + k);
    }
    if (k == count) return;
    std::array<uint32_t, 16> lastMaps;
    std::array<uint32_t, 16> lastIndices{};
    std::array<uint32_t, 16> lastStates;
    lastMaps.fill(maps[k]);
    std::copy(maps + k, maps + count, lastMaps.begin());
    std::copy(indices + k, indices + count, lastIndices.begin());
    hn::StoreU(lookupDagLanes(set, hn::LoadU(d, lastMaps.data()), hn::LoadU(d, lastIndices.data())), d,
               lastStates.data());
    for (size_t j = 0; k < count; ++j, ++k) to[k] = static_cast<uint8_t>(lastStates[j]);
}

}  // namespace filigree::encoding::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace filigree::encoding {

HWY_EXPORT(lookupDag);

namespace {

bool isAligned(const uint8_t* bytes) {
    return reinterpret_cast<uintptr_t>(bytes) % sizeof(uint32_t) == 0;
}

}  // namespace

void DagReader::lookup(std::span<const uint32_t> maps, std::span<const uint32_t> indices,
                       std::span<micromap::State> states) const {
    assert(indices.size() == maps.size() && states.size() == maps.size());
    if (isAligned(set_.payload.data()) && isAligned(set_.descriptors.data())) {
        HWY_DYNAMIC_DISPATCH(lookupDag)(set_, maps.data(), indices.data(), states.data(), maps.size());
    } else {
        for (size_t k = 0; k < maps.size(); ++k) states[k] = at(maps[k], indices[k]);
    }
}

void DagReader::lookup(std::span<const uint32_t> maps, std::span<const float> u, std::span<const float> v,
                       std::span<micromap::State> states) const {
    lookupByCurve(*this, maps, u, v, states);
}

uint64_t DagReader::bitsRead(uint32_t map, uint32_t index) const {
    const uint32_t from = descriptor(map);
    uint32_t node = from & dag::rootMask;
    uint64_t words = 2;  // the descriptor and the root's head
    for (unsigned shift = filigree_dag_root_shift_(from >> dag::rootBits);; shift -= 4) {
        const uint32_t head = word(node);
        const uint32_t child = (index >> shift) & 15;
        if (((head >> child) & 1) == 0) return 32 * words;
        if (shift == 4) return 32 * (words + 1);
        node = word(node + 1 + filigree_rank16(head, child));
        words += 2;
    }
}

}  // namespace filigree::encoding
#endif
