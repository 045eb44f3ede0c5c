#include "quadmap/vq2_quadrant.h"

namespace filigree::quadmap {
namespace {

using WordTable = std::array<std::array<uint8_t, word2Count + 1>, transformCount>;

constexpr WordTable transformedWords = [] {
    WordTable table{};
    for (unsigned t = 0; t < transformCount; ++t) {
        for (unsigned number = 0; number < word2Count; ++number) {
            const uint32_t known = transformedCells(static_cast<Transform>(t), 2, number % 14 + 1);
            table[t][number] = static_cast<uint8_t>(number / 14 * 14 + known - 1);
        }
        table[t][noWord2] = noWord2;
    }
    return table;
}();

Word2 transformedCode(Transform transform, Word2 code) {
    return static_cast<Word2>((code & 16) | transformedCells(transform, 2, code & 15U));
}

Gains gainsBy(const Quadrant2& quadrant, Word2 word, const Weights& weights) {
    Gains gains;
    for (unsigned v = 0; v < quadrant.size(); ++v) {
        const unsigned gain = gainOf(quadrant[v], word, weights);
        for (unsigned g = 0; g < gain; ++g) {
            (g < 4 ? gains.low : gains.high) |= uint64_t{1} << (16 * (g % 4) + v);
        }
    }
    return gains;
}

}  // namespace

unsigned transformedWord2(Transform transform, unsigned number) {
    return transformedWords[transform][number];
}

std::array<Quadrant2, 4> quadrantsOf(const Square& square) {
    assert(square.side == vq2Side);
    std::array<Quadrant2, 4> quadrants;
    for (unsigned y = 0; y < vq2Side; ++y) {
        for (unsigned x = 0; x < vq2Side; ++x) {
            Vector2& vector = quadrants[y / 8 * 2 + x / 8][y % 8 / 2 * 4 + x % 8 / 2];
            const auto bit = static_cast<uint8_t>(1U << (y % 2 * 2 + x % 2));
            const Region region = square.at(x, y);
            if (region == Region::transparent) vector.transparent |= bit;
            if (region == Region::opaque) vector.opaque |= bit;
            if (region == Region::free) vector.free |= bit;
        }
    }
    return quadrants;
}

unsigned gainOf(const Vector2& vector, Word2 word, const Weights& weights) {
    const bool opaque = (word & 16) != 0;
    const unsigned known = word & 15U;
    const unsigned side = opaque ? vector.opaque : vector.transparent;
    if ((known & ~(side | vector.free)) != 0) return 0;
    return static_cast<unsigned>(std::popcount(known & side)) *
           (opaque ? weights.opaque : weights.transparent);
}

QuadrantGains gainsOf(const Quadrant2& quadrant, const Weights& weights) {
    QuadrantGains gains;
    gains.transparent = gainsBy(quadrant, 15, weights);
    gains.opaque = gainsBy(quadrant, 31, weights);
    for (unsigned number = 0; number < word2Count; ++number) {
        gains.words[number] = gainsBy(quadrant, word2Code(number), weights);
    }
    return gains;
}

void assignIndices(const Quadrant2& vectors, const std::array<Word2, 8>& words, const Weights& weights,
                   unsigned quadrant, Vq2& map) {
    for (unsigned v = 0; v < vectors.size(); ++v) {
        unsigned best = 1;
        unsigned most = 0;
        for (unsigned index = 0; index < words.size(); ++index) {
            const unsigned gain = gainOf(vectors[v], words[index], weights);
            if (gain > most) {
                most = gain;
                best = index;
            }
        }
        const unsigned x = quadrant % 2 * 4 + v % 4;
        const unsigned y = quadrant / 2 * 4 + v / 4;
        map.indices[8 * y + x] = static_cast<uint8_t>(best);
    }
}

std::array<Word2, 8> shownWords(const Vq2& map, unsigned quadrant) {
    const Transform transform = map.transforms[quadrant];
    std::array<Word2, 8> words{15, 0, 31};
    for (unsigned k = 0; k < 3; ++k) words[3 + k] = transformedCode(transform, map.shared[k]);
    for (unsigned k = 0; k < 2; ++k) words[6 + k] = transformedCode(transform, map.own[quadrant][k]);
    return words;
}

std::array<Word2, 8> shownPlusWords(const Vq2& map, unsigned quadrant) {
    std::array<Word2, 8> words = shownWords(map, quadrant);
    const Vq2PlusReading reading = vq2PlusReading(map, quadrant);
    if (reading.rereads) {
        const Word2 rotated = transformedCode(reading.rotation, map.shared[0]);
        words[reading.index] = transformedCode(map.transforms[quadrant], rotated);
    }
    return words;
}

}  // namespace filigree::quadmap
