#include "filigree/quadmap/vq4.h"

#include "filigree/core/bytes.h"

#include "filigree_lookup.h"
#include "quadmap/fields.h"

namespace filigree::quadmap {
namespace {

constexpr size_t wordStart = 32;
constexpr size_t tailStart = 58;
constexpr size_t tailBytes = 6;

constexpr unsigned paletteBits(Word4Kind kind) {
    return kind == Word4Kind::simple ? 1 : kind == Word4Kind::generic ? 4 : 2;
}

// The palettes of all four parts from the bits that a kind stores.
constexpr std::array<uint8_t, 4> spreads{0xf, 0xa, 0xc, 0};  // the parts that the last bit speaks for
constexpr uint8_t palettesFrom(Word4Kind kind, unsigned bits) {
    if (kind == Word4Kind::generic) return static_cast<uint8_t>(bits);
    const uint8_t second = spreads[static_cast<size_t>(kind)];
    if (kind == Word4Kind::simple) return (bits & 1) != 0 ? second : 0;
    const auto first = static_cast<uint8_t>(0xf ^ second);
    return static_cast<uint8_t>(((bits & 1) != 0 ? first : 0) | ((bits & 2) != 0 ? second : 0));
}
constexpr unsigned palettesOf(Word4Kind kind, uint8_t palettes) {
    switch (kind) {
        case Word4Kind::simple:
            return palettes & 1U;
        case Word4Kind::vertical:
            return palettes & 3U;
        case Word4Kind::horizontal:
            return (palettes & 1U) | (palettes >> 1 & 2U);
        case Word4Kind::generic:
            break;
    }
    return palettes;
}

constexpr std::array<Word4Kind, word4Count> kindsOf(unsigned simple, unsigned generic, bool simpleFirst) {
    std::array<Word4Kind, word4Count> kinds{};
    unsigned at = 0;
    const auto put = [&](Word4Kind kind, unsigned count) {
        for (unsigned k = 0; k < count; ++k) kinds[at++] = kind;
    };
    put(simpleFirst ? Word4Kind::simple : Word4Kind::generic, simpleFirst ? simple : generic);
    put(Word4Kind::vertical, 1);
    put(Word4Kind::horizontal, 1);
    put(simpleFirst ? Word4Kind::generic : Word4Kind::simple, simpleFirst ? generic : simple);
    return kinds;
}
constexpr unsigned vq4IndexBits = 4;
constexpr unsigned vq4TransformBits = 3;

constexpr auto vq4Kinds = kindsOf(3, 8, true);
constexpr auto vq4PlusKinds = kindsOf(8, 3, false);

}  // namespace

const std::array<Word4Kind, word4Count>& word4Kinds(Vq4Layout layout) {
    return layout == Vq4Layout::vq4 ? vq4Kinds : vq4PlusKinds;
}

Vq4Block pack(const Vq4& map, Vq4Layout layout) {
    Vq4Block block{};
    for (unsigned row = 0; row < 8; ++row) {
        Packed indices;
        for (unsigned x = 0; x < 8; ++x) indices.put(map.indices[8 * row + x], 4);
        storeLe(block.data() + size_t{4} * row, static_cast<uint32_t>(indices.bits));
    }
    Packed tail;
    assert(layout != Vq4Layout::vq4 || map.transforms[0] == 0);
    const unsigned firstGroup = layout == Vq4Layout::vq4 ? 1 : 0;
    for (unsigned group = firstGroup; group < groupCount(layout); ++group) tail.put(map.transforms[group], 3);
    for (size_t k = 0; k < word4Count; ++k) {
        const Word4Kind kind = word4Kinds(layout)[k];
        storeLe(block.data() + wordStart + 2 * k, map.words[k].known);
        tail.put(palettesOf(kind, map.words[k].palettes), paletteBits(kind));
        assert(palettesFrom(kind, palettesOf(kind, map.words[k].palettes)) == map.words[k].palettes);
    }
    assert(tail.used == 8 * tailBytes);
    for (size_t k = 0; k < tailBytes; ++k) block[tailStart + k] = static_cast<uint8_t>(tail.bits >> (8 * k));
    return block;
}

Vq4 unpackVq4(Vq4View block, Vq4Layout layout) {
    Vq4 map;
    for (unsigned row = 0; row < 8; ++row) {
        Fields indices{loadLe<uint32_t>(block.data() + size_t{4} * row)};
        for (unsigned x = 0; x < 8; ++x) map.indices[8 * row + x] = indices.take(4);
    }
    Fields tail{loadLe<uint64_t>(block.data() + vq4Bytes - 8) >> 16};
    const unsigned firstGroup = layout == Vq4Layout::vq4 ? 1 : 0;
    for (unsigned group = firstGroup; group < groupCount(layout); ++group)
        map.transforms[group] = tail.take(3);
    for (size_t k = 0; k < word4Count; ++k) {
        const Word4Kind kind = word4Kinds(layout)[k];
        map.words[k].known = loadLe<uint16_t>(block.data() + wordStart + 2 * k);
        map.words[k].palettes = palettesFrom(kind, tail.take(paletteBits(kind)));
    }
    return map;
}

unsigned vq4BitsRead(Vq4View block, Vq4Layout layout, unsigned x, unsigned y) {
    if (filigree_vq4_index_(block.data(), x, y) < 3) return vq4IndexBits;
    const bool isStored = layout != Vq4Layout::vq4 || groupOf(layout, x / 4, y / 4) > 0;
    // The word's mask, and of its palettes that of the region's part.
    return vq4IndexBits + (isStored ? vq4TransformBits : 0) + 16 + 1;
}

Region vq4Region(Vq4View block, Vq4Layout layout, unsigned x, unsigned y) {
    assert(x < vq4Side && y < vq4Side);
    const unsigned plus = layout == Vq4Layout::vq4Plus ? 1 : 0;
    return static_cast<Region>(filigree_vq4_any_region_(block.data(), plus, x, y));
}

}  // namespace filigree::quadmap
