#include "filigree/encoding/tree.h"

#include "encoding/reader_of.h"
#include "encoding/tree_layout.h"

#include <cassert>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "encoding/tree_lookup.cpp"
// clang-format off
#include <hwy/foreach_target.h>
#include "encoding/lanes-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace filigree::encoding::HWY_NAMESPACE {

// Algorithm 3 in each lane, a bit of the structure a step; lanes that are at their leaf wait for the others.
// payload.size() >= 8: the last bytes are read from further ahead.
class TreeScan {
  public:
    explicit TreeScan(const EncodedView& set)
        : set_(set), lastLoad_(hn::Set(d_, set.payload.size() - 8)), two_(set.format == wide_ ? 1 : 0) {}

    LaneVector operator()(LaneVector map, LaneVector index) const {
        const auto at = hn::ShiftLeft<3>(map);
        const auto descriptor = gatherBytes(set_.descriptors.data(), at);
        const auto structure = hn::ShiftLeft<3>(hn::And(descriptor, hn::Set(d_, 0xffffffff)));
        const auto inner = hn::And(hn::ShiftRight<32>(descriptor), hn::Set(d_, 0xffffff));
        const auto leaf = scan(structure, hn::ShiftRight<56>(descriptor), index);
        const auto bytes = hn::ShiftRight<3>(hn::Add(hn::ShiftLeft<2>(inner), hn::Set(d_, 8)));
        const auto values = hn::Add(structure, hn::ShiftLeft<3>(bytes));
        const auto value = bitsFrom(hn::Add(values, two_ != 0 ? hn::ShiftLeft<1>(leaf) : leaf));
        return hn::And(value, hn::Set(d_, two_ != 0 ? 3 : 1));
    }

  private:
    static constexpr auto wide_ = micromap::Format::fourState;

    // The payload from bit `bit` on; at least one byte is right.
    [[nodiscard]] LaneVector bitsFrom(LaneVector bit) const {
        const auto load = hn::Min(hn::ShiftRight<3>(bit), lastLoad_);
        return hn::Shr(gatherBytes(set_.payload.data(), load), hn::Sub(bit, hn::ShiftLeft<3>(load)));
    }

    // The numbers of the leaves that hold `index`: d of the paper; t counts from the payload's start.
    [[nodiscard]] LaneVector scan(LaneVector t, LaneVector level, LaneVector index) const {
        const auto zero = hn::Zero(d_);
        const auto one = hn::Set(d_, 1);
        auto leaf = zero;
        auto child = zero;
        auto height = hn::ShiftLeft<1>(level);
        auto active = hn::Eq(zero, zero);
        while (!hn::AllFalse(d_, active)) {
            const auto inner = hn::TestBit(bitsFrom(t), one);
            const auto arrived = hn::Eq(child, zero);
            const auto descend = hn::And(arrived, inner);
            active = hn::AndNot(hn::AndNot(inner, arrived), active);
            const auto skippedLeaf = hn::AndNot(inner, hn::Not(arrived));
            leaf = hn::IfThenElse(hn::And(active, skippedLeaf), hn::Add(leaf, one), leaf);
            height = hn::IfThenElse(descend, hn::Sub(height, hn::Set(d_, 2)), height);
            const auto digit = hn::And(hn::Shr(index, hn::And(height, hn::Set(d_, 63))), hn::Set(d_, 3));
            const auto skipped = hn::Add(child, hn::IfThenElse(inner, hn::Set(d_, 3), hn::Not(zero)));
            child = hn::IfThenElse(active, hn::IfThenElse(descend, digit, skipped), child);
            t = hn::IfThenElse(active, hn::Add(t, one), t);
        }
        return leaf;
    }

    const EncodedView& set_;
    Lanes d_;
    LaneVector lastLoad_;
    unsigned two_;
};

void lookupTree(const EncodedView& set, const uint32_t* maps, const uint32_t* indices,
                micromap::State* states, size_t count) {
    lookupLanes(maps, indices, states, count, TreeScan(set));
}

}  // namespace filigree::encoding::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace filigree::encoding {

HWY_EXPORT(lookupTree);

// The paper's names: t is the place in the structure, d the leaf, child the subtrees still to skip.
micromap::State TreeReader::at(uint32_t map, uint32_t index) const {
    const TreeDescriptor found = loadTreeDescriptor(set_, map);
    const uint8_t* structure = set_.payload.data() + found.offset;
    uint64_t t = 0;
    uint64_t d = 0;
    unsigned height = 2 * found.level;
    while (bitAt(structure, t) != 0) {
        ++t;
        height -= 2;
        for (uint64_t child = index >> height & 3; child > 0; --child, ++t) {
            if (bitAt(structure, t) != 0) {
                child += 4;
            } else {
                ++d;
            }
        }
    }
    return valueAt(structure + structureBytes(found.inner), d, set_.format);
}

void TreeReader::lookup(std::span<const uint32_t> maps, std::span<const uint32_t> indices,
                        std::span<micromap::State> states) const {
    assert(indices.size() == maps.size() && states.size() == maps.size());
    if (set_.payload.size() >= 8) {
        HWY_DYNAMIC_DISPATCH(lookupTree)(set_, maps.data(), indices.data(), states.data(), maps.size());
    } else {
        for (size_t k = 0; k < maps.size(); ++k) states[k] = at(maps[k], indices[k]);
    }
}

void TreeReader::lookup(std::span<const uint32_t> maps, std::span<const float> u, std::span<const float> v,
                        std::span<micromap::State> states) const {
    lookupByCurve(*this, maps, u, v, states);
}

}  // namespace filigree::encoding
#endif
