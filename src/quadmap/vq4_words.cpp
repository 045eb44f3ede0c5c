#include "quadmap/vq4_words.h"

#include <algorithm>
#include <bit>
#include <cassert>

namespace filigree::quadmap {
namespace {

// The pieces of a word that share a palette, for each kind.
constexpr std::array<std::array<uint16_t, 4>, 4> pieces{{
    {0xffff},
    {0x3333, 0xcccc},
    {0x00ff, 0xff00},
    {0x0033, 0x00cc, 0x3300, 0xcc00},
}};

bool holds(Word4Kind kind, const States4& word) {
    return std::ranges::all_of(pieces[static_cast<size_t>(kind)], [&](uint16_t piece) {
        return (word.transparent & piece) == 0 || (word.opaque & piece) == 0;
    });
}

constexpr uint16_t narrow(unsigned cells) {
    return static_cast<uint16_t>(cells);
}

// Bits of each byte of a set of cells, transformed: [transform][which byte][byte].
using CellTable = std::array<std::array<std::array<uint16_t, 256>, 2>, transformCount>;
const CellTable& cellTable() {
    static const CellTable table = [] {
        CellTable made{};
        for (unsigned t = 0; t < transformCount; ++t) {
            for (unsigned byte = 0; byte < 256; ++byte) {
                made[t][0][byte] = narrow(transformedCells(static_cast<Transform>(t), 4, byte));
                made[t][1][byte] = narrow(transformedCells(static_cast<Transform>(t), 4, byte << 8));
            }
        }
        return made;
    }();
    return table;
}

uint16_t transformed(Transform transform, uint16_t cells) {
    const auto& table = cellTable()[transform];
    return narrow(table[0][cells & 0xff] | table[1][cells >> 8]);
}

// The vectors of a square, row by row.
std::array<Vector4, 64> vectorsOf(const Square& square) {
    assert(square.side == vq4Side);
    std::array<Vector4, 64> vectors{};
    for (unsigned y = 0; y < vq4Side; ++y) {
        for (unsigned x = 0; x < vq4Side; ++x) {
            Vector4& vector = vectors[y / 4 * 8 + x / 4];
            const unsigned bit = 1U << (y % 4 * 4 + x % 4);
            const Region region = square.at(x, y);
            if (region == Region::transparent) vector.transparent = narrow(vector.transparent | bit);
            if (region == Region::opaque) vector.opaque = narrow(vector.opaque | bit);
            if (region == Region::free) vector.free = narrow(vector.free | bit);
        }
    }
    return vectors;
}

unsigned gainOf(const Vector4& vector, const States4& word, const Weights& weights) {
    if ((word.transparent & ~(vector.transparent | vector.free)) != 0) return 0;
    if ((word.opaque & ~(vector.opaque | vector.free)) != 0) return 0;
    const auto count = [](unsigned cells) { return static_cast<unsigned>(std::popcount(cells)); };
    return weights.transparent * count(word.transparent & vector.transparent & 0xffffU) +
           weights.opaque * count(word.opaque & vector.opaque & 0xffffU);
}

uint8_t palettesOf(const States4& word, Word4Kind kind) {
    unsigned palettes = 0;
    for (const uint16_t piece : pieces[static_cast<size_t>(kind)]) {
        if ((word.opaque & piece) == 0) continue;
        for (unsigned part = 0; part < 4; ++part) {
            if ((piece & pieces[3][part]) != 0) palettes |= 1U << part;
        }
    }
    return static_cast<uint8_t>(palettes);
}

// Puts the words in the places of their kinds, those that fit few places first.
void placeWords(const std::vector<States4>& words, Vq4Layout layout, Vq4& map) {
    std::vector<States4> left = words;
    std::array<bool, word4Count> taken{};
    const auto place = [&](const States4& word, Word4Kind kind) {
        for (unsigned slot = 0; slot < word4Count; ++slot) {
            if (taken[slot] || word4Kinds(layout)[slot] != kind) continue;
            taken[slot] = true;
            map.words[slot] = {narrow(word.transparent | word.opaque), palettesOf(word, kind)};
            return true;
        }
        return false;
    };
    using enum Word4Kind;
    const auto placeShape = [&](Shape4 shape, std::initializer_list<Word4Kind> kinds) {
        for (const States4& word : left) {
            if (shapeOf(word) != shape) continue;
            [[maybe_unused]] const bool placed =
                std::ranges::any_of(kinds, [&](Word4Kind kind) { return place(word, kind); });
            assert(placed);
        }
    };
    placeShape(Shape4::vertical, {vertical, generic});
    placeShape(Shape4::horizontal, {horizontal, generic});
    placeShape(Shape4::halves, {vertical, horizontal, generic});
    placeShape(Shape4::generic, {generic});
    placeShape(Shape4::simple, {simple, vertical, horizontal, generic});
}

States4 statesOf(const Word4& word) {
    States4 states;
    for (unsigned part = 0; part < 4; ++part) {
        const unsigned known = word.known & pieces[3][part];
        if ((word.palettes >> part & 1) != 0) {
            states.opaque = narrow(states.opaque | known);
        } else {
            states.transparent = narrow(states.transparent | known);
        }
    }
    return states;
}

}  // namespace

Vector4 transformed(Transform transform, const Vector4& vector) {
    return {transformed(transform, vector.transparent), transformed(transform, vector.opaque),
            transformed(transform, vector.free)};
}
States4 transformed(Transform transform, const States4& states) {
    return {transformed(transform, states.transparent), transformed(transform, states.opaque)};
}

Shape4 shapeOf(const States4& word) {
    if (word.transparent == 0 || word.opaque == 0) return Shape4::simple;
    const bool vertical = holds(Word4Kind::vertical, word);
    const bool horizontal = holds(Word4Kind::horizontal, word);
    if (vertical && horizontal) return Shape4::halves;
    return vertical ? Shape4::vertical : horizontal ? Shape4::horizontal : Shape4::generic;
}

States4 reduced(States4 word, Word4Kind kind) {
    for (const uint16_t piece : pieces[static_cast<size_t>(kind)]) {
        const unsigned transparent = word.transparent & piece;
        const unsigned opaque = word.opaque & piece;
        if (transparent == 0 || opaque == 0) continue;
        if (std::popcount(transparent) >= std::popcount(opaque)) {
            word.opaque = narrow(word.opaque & ~opaque);
        } else {
            word.transparent = narrow(word.transparent & ~transparent);
        }
    }
    return word;
}

States4 representable(States4 word) {
    return reduced(word, Word4Kind::generic);
}

bool fits(const ShapeCounts& counts, Vq4Layout layout) {
    const auto [simple, halves, vertical, horizontal, generic] = counts;
    const unsigned genericPlaces = layout == Vq4Layout::vq4 ? 8 : 3;
    const unsigned spare = (vertical == 0 ? 1U : 0U) + (horizontal == 0 ? 1U : 0U);
    const unsigned inHalves = 2 - spare + std::min(spare, halves);
    return simple + halves + vertical + horizontal + generic <= word4Count &&
           halves + vertical + horizontal + generic - inHalves <= genericPlaces;
}

Demand4 demandOf(const Square& square, Vq4Layout layout, const Weights& weights) {
    Demand4 demand;
    demand.layout = layout;
    demand.weights = weights;
    const auto vectors = vectorsOf(square);
    for (unsigned v = 0; v < vectors.size(); ++v) {
        const Vector4& vector = vectors[v];
        const unsigned known = vector.transparent | vector.opaque;
        const bool mixed = ((known | vector.free) & 0xffffU) != 0xffff;
        if (known == 0 || (!mixed && (vector.transparent == 0 || vector.opaque == 0))) continue;
        demand.total += weights.transparent * static_cast<unsigned>(std::popcount(vector.transparent)) +
                        weights.opaque * static_cast<unsigned>(std::popcount(vector.opaque));
        for (Transform t = 0; t < transformCount; ++t) {
            demand.stored[groupOf(layout, v % 8, v / 8)][t].push_back(transformed(inverse(t), vector));
        }
    }
    return demand;
}

Vq4 mapOf(const Square& square, Book4 book, Vq4Layout layout, const Weights& weights) {
    if (layout == Vq4Layout::vq4 && book.transforms[0] != 0) {
        // The first quadrant is stored as it is: move its transform into all others and the words.
        const Transform first = book.transforms[0];
        for (States4& word : book.words) word = transformed(first, word);
        for (Transform& transform : book.transforms) transform = compose(transform, inverse(first));
    }
    Vq4 map;
    for (unsigned group = 0; group < groupCount(layout); ++group)
        map.transforms[group] = book.transforms[group];
    placeWords(book.words, layout, map);
    const auto vectors = vectorsOf(square);
    std::array<States4, 16> words{States4{0xffff, 0}, States4{}, States4{0, 0xffff}};
    for (unsigned k = 0; k < word4Count; ++k) words[3 + k] = statesOf(map.words[k]);
    for (unsigned v = 0; v < vectors.size(); ++v) {
        const Transform transform = map.transforms[groupOf(layout, v % 8, v / 8)];
        const Vector4 stored = transformed(inverse(transform), vectors[v]);
        unsigned best = 1;
        unsigned most = 0;
        for (unsigned index = 0; index < words.size(); ++index) {
            const unsigned gain = gainOf(stored, words[index], weights);
            if (gain <= most) continue;
            most = gain;
            best = index;
        }
        map.indices[v] = static_cast<uint8_t>(best);
    }
    return map;
}

}  // namespace filigree::quadmap
