#include "quadmap/vq4_gains.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "quadmap/vq4_gains.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace filigree::quadmap::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Cells = hn::CappedTag<uint16_t, 32>;
using Bytes = hn::CappedTag<uint8_t, 64>;
using Sums = hn::RepartitionToWide<hn::RepartitionToWide<hn::RepartitionToWide<Bytes>>>;

template <class V>
unsigned sumOfBytes(V bytes) {
    return static_cast<unsigned>(hn::GetLane(hn::SumOfLanes(Sums(), hn::SumsOf8(bytes))));
}

// The gains of the vectors in lanes k and on.
HWY_INLINE hn::Vec<Cells> gainsAt(const VectorLanes& lanes, const States4& word, const Weights& weights,
                                  size_t k) {
    const Cells d;
    const auto transparent = hn::Set(d, word.transparent);
    const auto opaque = hn::Set(d, word.opaque);
    const auto wrong = hn::Or(hn::And(transparent, hn::Load(d, lanes.notTransparent.data() + k)),
                              hn::And(opaque, hn::Load(d, lanes.notOpaque.data() + k)));
    auto first = hn::PopulationCount(hn::And(transparent, hn::Load(d, lanes.transparent.data() + k)));
    auto second = hn::PopulationCount(hn::And(opaque, hn::Load(d, lanes.opaque.data() + k)));
    if (weights.transparent == 2) first = hn::Add(first, first);
    if (weights.opaque == 2) second = hn::Add(second, second);
    return hn::IfThenElseZero(hn::Eq(wrong, hn::Zero(d)), hn::Add(first, second));
}

void fillRows(const VectorLanes& lanes, const States4* words, size_t count, const Weights& weights,
              GainRow* rows, uint16_t* sums) {
    const Cells d;
    const hn::Rebind<uint8_t, Cells> narrow;
    for (size_t w = 0; w < count; ++w) {
        auto sum = hn::Zero(d);
        rows[w] = {};
        for (size_t k = 0; k < lanes.count; k += hn::Lanes(d)) {
            const auto gains = gainsAt(lanes, words[w], weights, k);
            sum = hn::Add(sum, gains);
            hn::StoreU(hn::TruncateTo(narrow, gains), narrow, rows[w].gains.data() + k);
        }
        sums[w] = hn::GetLane(hn::SumOfLanes(d, sum));
    }
}

unsigned gainOfBook(const VectorLanes& lanes, const States4* words, size_t count, const Weights& weights) {
    const Cells d;
    auto sum = hn::Zero(d);
    for (size_t k = 0; k < lanes.count; k += hn::Lanes(d)) {
        auto most = hn::Zero(d);
        for (size_t w = 0; w < count; ++w) most = hn::Max(most, gainsAt(lanes, words[w], weights, k));
        sum = hn::Add(sum, most);
    }
    return hn::GetLane(hn::SumOfLanes(d, sum));
}

void larger(GainRow& row, const GainRow& other) {
    const Bytes d;
    for (size_t k = 0; k < lanes4; k += hn::Lanes(d)) {
        hn::Store(hn::Max(hn::Load(d, row.gains.data() + k), hn::Load(d, other.gains.data() + k)), d,
                  row.gains.data() + k);
    }
}

unsigned rowSum(const GainRow& row) {
    const Bytes d;
    auto sum = hn::Zero(Sums());
    for (size_t k = 0; k < lanes4; k += hn::Lanes(d)) {
        sum = hn::Add(sum, hn::SumsOf8(hn::Load(d, row.gains.data() + k)));
    }
    return static_cast<unsigned>(hn::GetLane(hn::SumOfLanes(Sums(), sum)));
}

void bestRow(const GainRow* rows, const uint16_t* sums, size_t first, size_t last, const GainRow& rest,
             unsigned restSum, BestRow& best) {
    const Bytes d;
    for (size_t row = first; row < last && restSum + sums[row] > best.total; ++row) {
        auto sum = hn::Zero(Sums());
        for (size_t k = 0; k < lanes4; k += hn::Lanes(d)) {
            const auto gains = hn::Load(d, rows[row].gains.data() + k);
            sum = hn::Add(sum, hn::SumsOf8(hn::Max(gains, hn::Load(d, rest.gains.data() + k))));
        }
        const auto total = static_cast<unsigned>(hn::GetLane(hn::SumOfLanes(Sums(), sum)));
        if (total > best.total) best = {total, row};
    }
}

}  // namespace filigree::quadmap::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace filigree::quadmap {

HWY_EXPORT(fillRows);
HWY_EXPORT(gainOfBook);
HWY_EXPORT(larger);
HWY_EXPORT(rowSum);
HWY_EXPORT(bestRow);

unsigned gainsOf(const VectorLanes& lanes, const States4& word, const Weights& weights, GainRow& row) {
    uint16_t sum = 0;
    HWY_DYNAMIC_DISPATCH(fillRows)(lanes, &word, 1, weights, &row, &sum);
    return sum;
}

void gainsOf(const VectorLanes& lanes, std::span<const States4> words, const Weights& weights,
             std::span<GainRow> rows, std::span<uint16_t> sums) {
    HWY_DYNAMIC_DISPATCH(fillRows)
    (lanes, words.data(), words.size(), weights, rows.data(), sums.data());
}

void takeLarger(GainRow& row, const GainRow& other) {
    HWY_DYNAMIC_DISPATCH(larger)(row, other);
}

unsigned sumOf(const GainRow& row) {
    return HWY_DYNAMIC_DISPATCH(rowSum)(row);
}

void findBest(std::span<const GainRow> rows, std::span<const uint16_t> sums, size_t first, size_t last,
              const GainRow& rest, unsigned restSum, BestRow& best) {
    HWY_DYNAMIC_DISPATCH(bestRow)(rows.data(), sums.data(), first, last, rest, restSum, best);
}

unsigned bookGain(const VectorLanes& lanes, std::span<const States4> words, const Weights& weights) {
    return HWY_DYNAMIC_DISPATCH(gainOfBook)(lanes, words.data(), words.size(), weights);
}

}  // namespace filigree::quadmap
#endif
