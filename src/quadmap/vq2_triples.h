// The three shared words of a VQ2 map: all sets of them, and what they are worth to a quadrant.
#pragma once

#include "quadmap/vq2_quadrant.h"

#include <algorithm>
#include <span>
#include <vector>

namespace filigree::quadmap {

inline constexpr unsigned tripleCount = 3276;  // 28 choose 3

// All sets of three words, rising, and how the transforms permute them.
class Triples {
  public:
    static const Triples& all();

    [[nodiscard]] const std::array<uint8_t, 3>& words(unsigned triple) const { return words_[triple]; }
    // The triple as `transform` shows it.
    [[nodiscard]] unsigned shown(unsigned triple, unsigned transform) const {
        return shown_[triple][transform];
    }
    // Triples that transforms turn into each other share an orbit.
    [[nodiscard]] unsigned orbit(unsigned triple) const { return orbit_[triple]; }
    [[nodiscard]] unsigned orbitCount() const { return orbitCount_; }

  private:
    Triples();
    std::vector<std::array<uint8_t, 3>> words_;
    std::vector<std::array<uint16_t, transformCount>> shown_;
    std::vector<uint16_t> orbit_;
    unsigned orbitCount_ = 0;
};

// A quadrant's own two words for given other words, numbers, and the total gain.
struct BestPair {
    unsigned total = 0;
    std::array<uint8_t, 2> words{noWord2, noWord2};
};

// The words that some best pair on top of `base`, or of more, consists of.
struct PairWords {
    std::array<uint8_t, word2Count> numbers{};
    unsigned count = 0;

    PairWords() = default;
    // Those with `code & mask == value` that are worth more than `base`, but none whose gains another's
    // include.
    PairWords(const QuadrantGains& quadrant, Gains base, unsigned mask, unsigned value);
};

// The best pair on top of `base`. Same inputs, same pair.
BestPair bestPair(const QuadrantGains& quadrant, Gains base);
// The same where one bit of both codes carries a message: the words differ in it or not. `byBit` holds the
// words without and with that bit.
BestPair bestPair(const QuadrantGains& quadrant, Gains base, const std::array<PairWords, 2>& byBit,
                  bool different);

// The total gain of a quadrant with each triple and the best pair for it.
using TripleTotals = std::array<uint16_t, tripleCount>;
void totalsOfTriples(const QuadrantGains& quadrant, TripleTotals& totals);

// The gains of the three words and both uniform ones.
inline Gains gainsWith(const QuadrantGains& quadrant, unsigned triple) {
    const auto& words = Triples::all().words(triple);
    return quadrant.transparent | quadrant.opaque | quadrant.words[words[0]] | quadrant.words[words[1]] |
           quadrant.words[words[2]];
}

}  // namespace filigree::quadmap
