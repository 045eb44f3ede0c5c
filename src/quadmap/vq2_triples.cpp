#include "quadmap/vq2_triples.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "quadmap/vq2_triples.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace filigree::quadmap::HWY_NAMESPACE {

// Compiled for each target for its population count.
template <bool wide>
unsigned size(Gains gains) {
    const auto low = static_cast<unsigned>(__builtin_popcountll(gains.low));
    return wide ? low + static_cast<unsigned>(__builtin_popcountll(gains.high)) : low;
}

// Words by what they are worth on their own, most first.
struct Ranked {
    std::array<uint16_t, word2Count> keys;  // gain times 32, then the place in `words` backwards
    unsigned count = 0;
    [[nodiscard]] unsigned gain(unsigned k) const { return keys[k] / 32U; }
    [[nodiscard]] unsigned word(unsigned k, const PairWords& words) const {
        return words.numbers[31U - keys[k] % 32U];
    }
};

template <bool wide>
Ranked ranked(const QuadrantGains& quadrant, const PairWords& words, Gains base) {
    Ranked order;
    for (unsigned k = 0; k < words.count; ++k) {
        const unsigned gain = size<wide>(quadrant.words[words.numbers[k]] - base);
        if (gain == 0) continue;
        const auto key = static_cast<uint16_t>(gain * 32 + 31 - k);
        unsigned at = order.count++;
        for (; at > 0 && order.keys[at - 1] < key; --at) order.keys[at] = order.keys[at - 1];
        order.keys[at] = key;
    }
    return order;
}

// Betters `best` with pairs of one word each of two lists, or with one of them alone. Gains of two words are
// at most the sum of each one's.
template <bool wide>
void searchPairs(const QuadrantGains& quadrant, Gains base, const PairWords& firsts, const PairWords& seconds,
                 BestPair& best) {
    const unsigned start = size<wide>(base);
    const Ranked first = ranked<wide>(quadrant, firsts, base);
    const Ranked second = &firsts == &seconds ? first : ranked<wide>(quadrant, seconds, base);
    const auto tryPair = [&](unsigned total, unsigned a, unsigned b) {
        if (total > best.total) {
            best = {total, {static_cast<uint8_t>(a), static_cast<uint8_t>(b)}};
        }
    };
    if (first.count > 0) tryPair(start + first.gain(0), first.word(0, firsts), noWord2);
    if (second.count > 0) tryPair(start + second.gain(0), second.word(0, seconds), noWord2);
    for (unsigned i = 0; i < first.count; ++i) {
        const Gains withFirst = base | quadrant.words[first.word(i, firsts)];
        for (unsigned j = &firsts == &seconds ? i + 1 : 0; j < second.count; ++j) {
            if (start + first.gain(i) + second.gain(j) <= best.total) break;
            const unsigned b = second.word(j, seconds);
            tryPair(size<wide>(withFirst | quadrant.words[b]), first.word(i, firsts), b);
        }
    }
}

template <bool wide>
void allTriples(const QuadrantGains& quadrant, TripleTotals& totals) {
    const Triples& triples = Triples::all();
    const Gains uniform = quadrant.transparent | quadrant.opaque;
    const PairWords words(quadrant, uniform, 0, 0);
    // Many words are worth nothing here; triples that differ only in those share a total.
    std::array<uint8_t, word2Count> useful{};
    unsigned kinds = 1;  // 0 stands for all that are worth nothing
    std::array<Gains, word2Count + 1> kindGains{};
    for (unsigned number = 0; number < word2Count; ++number) {
        if ((quadrant.words[number] - uniform).none()) continue;
        kindGains[kinds] = quadrant.words[number];
        useful[number] = static_cast<uint8_t>(kinds++);
    }
    std::vector<uint16_t> known(size_t{kinds} * kinds * kinds);
    for (unsigned triple = 0; triple < tripleCount; ++triple) {
        const auto& [a, b, c] = triples.words(triple);
        // Kinds rise with the numbers, so those worth nothing have to move to the front.
        std::array<unsigned, 3> kind{useful[a], useful[b], useful[c]};
        if (kind[1] == 0) std::swap(kind[0], kind[1]);
        if (kind[2] == 0) kind = {0, kind[0], kind[1]};
        uint16_t& total = known[(size_t{kind[0]} * kinds + kind[1]) * kinds + kind[2]];
        if (total == 0) {
            const Gains base = uniform | kindGains[kind[0]] | kindGains[kind[1]] | kindGains[kind[2]];
            BestPair best{size<wide>(base), {noWord2, noWord2}};
            searchPairs<wide>(quadrant, base, words, words, best);
            total = static_cast<uint16_t>(best.total + 1);
        }
        totals[triple] = static_cast<uint16_t>(total - 1);
    }
}

void totals(const QuadrantGains& quadrant, bool wide, TripleTotals& found) {
    wide ? allTriples<true>(quadrant, found) : allTriples<false>(quadrant, found);
}

void pair(const QuadrantGains& quadrant, Gains base, const PairWords& firsts, const PairWords& seconds,
          BestPair& best) {
    searchPairs<true>(quadrant, base, firsts, seconds, best);
}

}  // namespace filigree::quadmap::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace filigree::quadmap {

HWY_EXPORT(totals);
HWY_EXPORT(pair);

Triples::Triples() : shown_(tripleCount), orbit_(tripleCount, UINT16_MAX) {
    std::array<std::array<std::array<uint16_t, word2Count>, word2Count>, word2Count> numbers{};
    for (uint8_t a = 0; a < word2Count; ++a) {
        for (uint8_t b = a + 1; b < word2Count; ++b) {
            for (uint8_t c = b + 1; c < word2Count; ++c) {
                numbers[a][b][c] = static_cast<uint16_t>(words_.size());
                words_.push_back({a, b, c});
            }
        }
    }
    for (unsigned triple = 0; triple < tripleCount; ++triple) {
        for (unsigned t = 0; t < transformCount; ++t) {
            std::array<unsigned, 3> shown{};
            for (unsigned k = 0; k < 3; ++k)
                shown[k] = transformedWord2(static_cast<Transform>(t), words_[triple][k]);
            std::ranges::sort(shown);
            shown_[triple][t] = numbers[shown[0]][shown[1]][shown[2]];
        }
        if (orbit_[triple] != UINT16_MAX) continue;
        for (const uint16_t other : shown_[triple]) orbit_[other] = static_cast<uint16_t>(orbitCount_);
        ++orbitCount_;
    }
}

PairWords::PairWords(const QuadrantGains& quadrant, Gains base, unsigned mask, unsigned value) {
    std::array<Gains, word2Count> more;
    const auto allowed = [&](unsigned number) { return (word2Code(number) & mask) == value; };
    for (unsigned number = 0; number < word2Count; ++number) more[number] = quadrant.words[number] - base;
    const auto includes = [&](unsigned other, unsigned number) {
        if (other == number || !allowed(other) || !(more[number] - more[other]).none()) return false;
        return more[other] != more[number] || other < number;
    };
    for (unsigned number = 0; number < word2Count; ++number) {
        if (!allowed(number) || more[number].none()) continue;
        bool included = false;
        for (unsigned other = 0; other < word2Count && !included; ++other) included = includes(other, number);
        if (!included) numbers[count++] = static_cast<uint8_t>(number);
    }
}

const Triples& Triples::all() {
    static const Triples triples;
    return triples;
}

void totalsOfTriples(const QuadrantGains& quadrant, TripleTotals& found) {
    bool wide = (quadrant.transparent.high | quadrant.opaque.high) != 0;
    for (const Gains& word : quadrant.words) wide = wide || word.high != 0;
    HWY_DYNAMIC_DISPATCH(totals)(quadrant, wide, found);
}

BestPair bestPair(const QuadrantGains& quadrant, Gains base) {
    BestPair best{base.total(), {noWord2, noWord2}};
    const PairWords words(quadrant, base, 0, 0);
    HWY_DYNAMIC_DISPATCH(pair)(quadrant, base, words, words, best);
    return best;
}

BestPair bestPair(const QuadrantGains& quadrant, Gains base, const std::array<PairWords, 2>& byBit,
                  bool different) {
    BestPair best{base.total(), {noWord2, noWord2}};
    if (different) {
        HWY_DYNAMIC_DISPATCH(pair)(quadrant, base, byBit[0], byBit[1], best);
        return best;
    }
    for (const PairWords& words : byBit) HWY_DYNAMIC_DISPATCH(pair)(quadrant, base, words, words, best);
    return best;
}

}  // namespace filigree::quadmap
#endif
