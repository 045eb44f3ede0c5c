#include "filigree/encoding/indexed_tree.h"

#include "encoding/indexed_tree_layout.h"
#include "encoding/reader_of.h"

#include <bit>
#include <cassert>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "encoding/indexed_tree_batch.cpp"
// clang-format off
#include <hwy/foreach_target.h>
#include "encoding/lanes-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace filigree::encoding::HWY_NAMESPACE {

// The scalar lookup in lanes; the same names stand for the same steps.
class IndexedTreeLanes {
  public:
    explicit IndexedTreeLanes(const EncodedView& set)
        : set_(set), fourState_(set.format == micromap::Format::fourState) {}

    LaneVector operator()(LaneVector map, LaneVector index) const {
        const auto descriptor = gatherBytes(set_.descriptors.data(), hn::ShiftLeft<3>(map));
        const auto structure = hn::And(descriptor, constant(0xffffffff));
        const auto inner = hn::And(hn::ShiftRight<32>(descriptor), constant(0xffffff));
        const auto level = hn::ShiftRight<56>(descriptor);
        const auto leaves = hn::Add(hn::Add(inner, hn::ShiftLeft<1>(inner)), constant(1));
        const auto values =
            hn::Add(structure, hn::ShiftRight<3>(hn::Add(hn::ShiftLeft<2>(inner), constant(8))));
        const auto valueBits = fourState_ ? hn::ShiftLeft<1>(leaves) : leaves;
        const auto directory = hn::Add(values, hn::ShiftRight<3>(hn::Add(valueBits, constant(7))));
        const auto samples = hn::ShiftRight<sampleShift>(hn::Sub(leaves, constant(1)));

        const Found sample = sampleBefore(directory, samples, level, index);
        const Found leaf = leafFrom(structure, sample, level, index);
        const auto below = hn::ShiftLeft<1>(hn::Sub(level, leaf.depth));
        const auto digits = digitSum(hn::Shr(index, below));
        const auto rank = hn::ShiftRight<2>(hn::Add(times3(hn::Sub(leaf.bit, leaf.depth)), digits));
        const auto bit = fourState_ ? hn::ShiftLeft<1>(rank) : rank;
        const auto bytes = gatherBytes(set_.payload.data(), hn::Add(values, hn::ShiftRight<3>(bit)));
        return hn::And(hn::Shr(bytes, hn::And(bit, constant(7))), constant(fourState_ ? 3 : 1));
    }

  private:
    static constexpr int sampleShift = std::countr_zero(sampleStep);

    // Nodes, and the curve index that they begin at where it is asked for.
    struct Found {
        LaneVector bit, depth, first;
    };

    [[nodiscard]] LaneVector constant(uint64_t value) const { return hn::Set(d_, value); }
    [[nodiscard]] static LaneVector times3(LaneVector v) { return hn::Add(v, hn::ShiftLeft<1>(v)); }

    // Of at most 16 digits.
    [[nodiscard]] LaneVector digitSum(LaneVector index) const {
        const auto pairs = constant(0x33333333);
        const auto bytes = constant(0x0f0f0f0f);
        index = hn::Add(hn::And(index, pairs), hn::And(hn::ShiftRight<2>(index), pairs));
        index = hn::Add(hn::And(index, bytes), hn::And(hn::ShiftRight<4>(index), bytes));
        index = hn::Add(index, hn::ShiftRight<16>(index));
        return hn::And(hn::Add(index, hn::ShiftRight<8>(index)), constant(0xff));
    }

    // Exact thirds of numbers below 2^32: 0x55555555 is -1/3 modulo 2^32.
    [[nodiscard]] LaneVector third(LaneVector v) const {
        v = hn::Add(v, hn::ShiftLeft<2>(v));
        v = hn::Add(v, hn::ShiftLeft<4>(v));
        v = hn::Add(v, hn::ShiftLeft<8>(v));
        v = hn::Add(v, hn::ShiftLeft<16>(v));
        return hn::And(hn::Sub(hn::Zero(d_), v), constant(0xffffffff));
    }

    // place * bytes, for 0 to 3 bytes.
    [[nodiscard]] LaneVector byteOf(LaneVector place, LaneVector bytes) const {
        const auto once = hn::IfThenElseZero(hn::TestBit(bytes, constant(1)), place);
        return hn::Add(once, hn::IfThenElseZero(hn::TestBit(bytes, constant(2)), hn::ShiftLeft<1>(place)));
    }

    [[nodiscard]] LaneVector bitWidth(LaneVector v) const {
        v = hn::Or(v, hn::ShiftRight<1>(v));
        v = hn::Or(v, hn::ShiftRight<2>(v));
        v = hn::Or(v, hn::ShiftRight<4>(v));
        v = hn::Or(v, hn::ShiftRight<8>(v));
        return hn::PopulationCount(hn::Or(v, hn::ShiftRight<16>(v)));
    }

    [[nodiscard]] Found sampleAt(LaneVector first, LaneVector leavesBefore, LaneVector level) const {
        const auto lowest = hn::And(first, hn::Sub(hn::Zero(d_), first));
        const auto zeros = hn::PopulationCount(hn::Sub(lowest, constant(1)));
        const auto depth = hn::Sub(level, hn::Min(level, hn::ShiftRight<1>(zeros)));
        const auto before = hn::Sub(hn::ShiftLeft<2>(leavesBefore), digitSum(first));
        return {hn::Add(depth, third(before)), depth, first};
    }

    [[nodiscard]] Found sampleBefore(LaneVector directory, LaneVector left, LaneVector level,
                                     LaneVector index) const {
        const auto zero = hn::Zero(d_);
        const auto one = constant(1);
        const auto bytes = hn::ShiftRight<3>(hn::Add(hn::ShiftLeft<1>(level), constant(7)));
        const auto mask = hn::Sub(hn::Shl(one, hn::ShiftLeft<3>(bytes)), one);
        auto sample = zero;
        auto first = zero;
        for (auto open = hn::Ne(left, zero); !hn::AllFalse(d_, open); open = hn::Ne(left, zero)) {
            const auto half = hn::ShiftRight<1>(hn::Add(left, one));
            // Lanes that are done have 0 left and half 0: they load what they found, or the first sample.
            const auto place = hn::Sub(hn::Max(hn::Add(sample, half), one), one);
            const auto offset = hn::Add(directory, byteOf(place, bytes));
            const auto middle = hn::And(gatherBytes(set_.payload.data(), offset), mask);
            const auto before = hn::AndNot(hn::Gt(middle, index), open);
            sample = hn::IfThenElse(before, hn::Add(sample, half), sample);
            first = hn::IfThenElse(before, middle, first);
            const auto rest = hn::IfThenElse(before, hn::Sub(left, half), hn::Sub(half, one));
            left = hn::IfThenElse(open, rest, zero);
        }
        return sampleAt(first, hn::ShiftLeft<sampleShift>(sample), level);
    }

    [[nodiscard]] Found leafFrom(LaneVector structure, const Found& sample, LaneVector level,
                                 LaneVector index) const {
        const auto zero = hn::Zero(d_);
        const auto one = constant(1);
        const auto same = hn::ShiftRight<1>(hn::Add(bitWidth(hn::Xor(sample.first, index)), one));
        auto bit = sample.bit;
        auto depth = hn::Min(sample.depth, hn::Sub(hn::Add(level, one), same));
        auto below = hn::ShiftLeft<1>(hn::Sub(level, depth));
        auto skip = hn::Sub(hn::Add(times3(hn::Sub(sample.depth, depth)), digitSum(hn::Shr(index, below))),
                            digitSum(sample.first));
        auto active = hn::Eq(zero, zero);
        while (!hn::AllFalse(d_, active)) {
            const auto at = hn::Add(structure, hn::ShiftRight<3>(bit));
            const auto bits = hn::Shr(gatherBytes(set_.payload.data(), at), hn::And(bit, constant(7)));
            const auto entry = gatherBytes(reinterpret_cast<const uint8_t*>(filigree_skip_table_),
                                           hn::ShiftLeft<3>(hn::And(bits, constant(255))));
            const auto none = hn::Eq(skip, zero);
            const auto nibble = hn::ShiftLeft<2>(hn::Min(hn::Sub(skip, one), constant(8)));
            const auto length = hn::IfThenZeroElse(none, hn::And(hn::Shr(entry, nibble), constant(15)));
            const auto missed = hn::AndNot(none, hn::Eq(length, zero));
            const auto inner = hn::TestBit(hn::Shr(bits, length), one);
            const auto descends = hn::AndNot(missed, inner);
            active = hn::Or(missed, inner);
            depth = hn::IfThenElse(descends, hn::Add(depth, one), depth);
            below = hn::ShiftLeft<1>(hn::Sub(level, depth));
            const auto digit = hn::And(hn::Shr(index, below), constant(3));
            const auto rest = hn::Sub(hn::Add(skip, hn::ShiftRight<40>(entry)), constant(8));
            // A leaf that is reached is reached again in every step to come.
            skip = hn::IfThenElse(missed, rest, hn::IfThenElseZero(inner, digit));
            const auto reached = hn::Add(bit, length);
            const auto next = hn::IfThenElse(descends, hn::Add(reached, one), reached);
            bit = hn::IfThenElse(missed, hn::Add(bit, constant(8)), next);
        }
        return {bit, depth, zero};
    }

    const EncodedView& set_;
    Lanes d_;
    bool fourState_;
};

void lookupIndexedTree(const EncodedView& set, const uint32_t* maps, const uint32_t* indices,
                       micromap::State* states, size_t count) {
    lookupLanes(maps, indices, states, count, IndexedTreeLanes(set));
}

}  // namespace filigree::encoding::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace filigree::encoding {

HWY_EXPORT(lookupIndexedTree);

void IndexedTreeReader::lookup(std::span<const uint32_t> maps, std::span<const uint32_t> indices,
                               std::span<micromap::State> states) const {
    assert(indices.size() == maps.size() && states.size() == maps.size());
    HWY_DYNAMIC_DISPATCH(lookupIndexedTree)
    (set_, maps.data(), indices.data(), states.data(), maps.size());
}

void IndexedTreeReader::lookup(std::span<const uint32_t> maps, std::span<const float> u,
                               std::span<const float> v, std::span<micromap::State> states) const {
    lookupByCurve(*this, maps, u, v, states);
}

}  // namespace filigree::encoding
#endif
