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

// Algorithm 3 in each lane. All lanes read one bit a step, until the last one is at its leaf.
// payload.size() >= 8: the last bytes are read from further ahead.
class TreeScan {
  public:
    explicit TreeScan(const EncodedView& set)
        : set_(set),
          lastLoad_(hn::Set(d_, set.payload.size() - 8)),
          fourState_(set.format == micromap::Format::fourState) {}

    LaneVector operator()(LaneVector map, LaneVector index) const {
        const auto descriptor = gatherBytes(set_.descriptors.data(), hn::ShiftLeft<3>(map));
        const auto structure = hn::ShiftLeft<3>(hn::And(descriptor, hn::Set(d_, 0xffffffff)));
        const auto inner = hn::And(hn::ShiftRight<32>(descriptor), hn::Set(d_, 0xffffff));
        const auto leaf = scan(structure, hn::ShiftRight<56>(descriptor), index);
        const auto bytes = hn::ShiftRight<3>(hn::Add(hn::ShiftLeft<2>(inner), hn::Set(d_, 8)));
        const auto values = hn::Add(structure, hn::ShiftLeft<3>(bytes));
        const auto value = bitsFrom(hn::Add(values, fourState_ ? hn::ShiftLeft<1>(leaf) : leaf));
        return hn::And(value, hn::Set(d_, fourState_ ? 3 : 1));
    }

  private:
    static constexpr unsigned window = 56;

    // The payload from bit `bit` on: `window` bits, or all up to its end.
    [[nodiscard]] LaneVector bitsFrom(LaneVector bit) const {
        const auto load = hn::Min(hn::ShiftRight<3>(bit), lastLoad_);
        return hn::Shr(gatherBytes(set_.payload.data(), load), hn::Sub(bit, hn::ShiftLeft<3>(load)));
    }

    // The leaves that hold `index`, by number; t counts from the payload's start.
    [[nodiscard]] LaneVector scan(LaneVector t, LaneVector level, LaneVector index) const {
        const auto one = hn::Set(d_, 1);
        // The digits of the index from the top bits down.
        const auto height = hn::Sub(hn::Set(d_, 62), hn::ShiftLeft<1>(level));
        auto path = hn::ShiftLeft<2>(hn::Shl(index, height));
        auto child = hn::Zero(d_);
        auto d = hn::Zero(d_);
        auto active = hn::Eq(d, d);
        while (!hn::AllFalse(d_, active)) {
            auto bits = bitsFrom(t);
            for (unsigned k = 0; k < window; ++k) {
                const auto bit = hn::And(bits, one);
                const auto inner = hn::Eq(bit, one);
                const auto arrived = hn::Eq(child, hn::Zero(d_));
                const auto descends = hn::And(inner, arrived);
                active = hn::AndNot(hn::AndNot(inner, arrived), active);
                d = hn::Add(d, hn::IfThenElseZero(hn::AndNot(inner, active), one));
                const auto others = hn::Add(child, hn::Sub(hn::ShiftLeft<2>(bit), one));
                child = hn::IfThenElse(descends, hn::ShiftRight<62>(path), others);
                path = hn::IfThenElse(descends, hn::ShiftLeft<2>(path), path);
                bits = hn::ShiftRight<1>(bits);
            }
            t = hn::IfThenElse(active, hn::Add(t, hn::Set(d_, window)), t);
        }
        return d;
    }

    const EncodedView& set_;
    Lanes d_;
    LaneVector lastLoad_;
    bool fourState_;
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

uint64_t TreeReader::bitsRead(uint32_t map, uint32_t index) const {
    const TreeDescriptor found = loadTreeDescriptor(set_, map);
    const uint8_t* structure = set_.payload.data() + found.offset;
    return 8 * treeDescriptorBytes + filigree_tree_scan_(structure, found.level, index).t + 1 +
           micromap::bitsPerState(set_.format);
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
