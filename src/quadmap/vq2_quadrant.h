// What each 2 x 2 word is worth to a quadrant of a square, as sets.
#pragma once

#include "filigree/quadmap/encode.h"
#include "filigree/quadmap/vq2.h"

#include <array>
#include <bit>
#include <cstdint>

namespace filigree::quadmap {

// The 28 words worth storing: number 14p + m - 1 for palette p and the known regions m = 1..14. One more
// number stands for none.
inline constexpr unsigned word2Count = 28;
inline constexpr unsigned noWord2 = word2Count;
constexpr Word2 word2Code(unsigned number) {
    return static_cast<Word2>(number / 14 * 16 + number % 14 + 1);
}
constexpr unsigned word2Number(Word2 code) {
    return code / 16 * 14U + code % 16 - 1;
}

// The number of word `number` under `transform`; noWord2 stays.
unsigned transformedWord2(Transform transform, unsigned number);

// The code to store so that `transform` shows word `shown`; of noWord2 a word that keeps nothing.
inline Word2 storedWord2(Transform transform, unsigned shown) {
    return shown == noWord2 ? Word2{0} : word2Code(transformedWord2(inverse(transform), shown));
}

// A vector of the square: its transparent, opaque and free regions, bit 2y + x each.
struct Vector2 {
    uint8_t transparent = 0;
    uint8_t opaque = 0;
    uint8_t free = 0;
};
using Quadrant2 = std::array<Vector2, 16>;  // row by row

std::array<Quadrant2, 4> quadrantsOf(const Square& square);

// What one vector gains by a word: the weight of its regions that become known. 0 where the word would be
// wrong.
unsigned gainOf(const Vector2& vector, Word2 word, const Weights& weights);

// What the 16 vectors of a quadrant gain: bit 16g + v is set where vector v gains more than g. The gain of a
// vector from several words is the largest, so that of a book is the union.
struct Gains {
    uint64_t low = 0;   // g = 0..3
    uint64_t high = 0;  // g = 4..7: only when a state weighs two

    friend Gains operator|(Gains a, Gains b) { return {a.low | b.low, a.high | b.high}; }
    // What of `a` is not in `b`.
    friend Gains operator-(Gains a, Gains b) { return {a.low & ~b.low, a.high & ~b.high}; }
    friend bool operator==(const Gains&, const Gains&) = default;
    [[nodiscard]] bool none() const { return (low | high) == 0; }
    [[nodiscard]] unsigned total() const {
        return static_cast<unsigned>(std::popcount(low) + std::popcount(high));
    }
};

// A quadrant as the searches see it: gains by the uniform words and by each other word.
struct QuadrantGains {
    Gains transparent;
    Gains opaque;
    std::array<Gains, word2Count + 1> words;
};
QuadrantGains gainsOf(const Quadrant2& quadrant, const Weights& weights);

// The indices of a quadrant for given words: the best for each vector, the lowest of equals. `words` are
// the codes for indices 0..7 as shown, transforms and all.
void assignIndices(const Quadrant2& vectors, const std::array<Word2, 8>& words, const Weights& weights,
                   unsigned quadrant, Vq2& map);

// The codes that indices 0..7 of a quadrant stand for as shown, read as VQ2 or as VQ2+.
std::array<Word2, 8> shownWords(const Vq2& map, unsigned quadrant);
std::array<Word2, 8> shownPlusWords(const Vq2& map, unsigned quadrant);

}  // namespace filigree::quadmap
