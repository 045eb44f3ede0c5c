#include "filigree/quadmap/vq2.h"

#include "filigree/core/bytes.h"

#include "filigree_lookup.h"
#include "quadmap/fields.h"

namespace filigree::quadmap {
namespace {

constexpr size_t indexRowBytes = 3;
constexpr size_t bookStart = 24;

constexpr unsigned vq2IndexBits = 3;
constexpr unsigned vq2TransformBits = 3;
constexpr unsigned vq2WordBits = 5;

// The index, and of a word its transform, which the first quadrant has none of, and the word.
unsigned bitsOf(const filigree_vq2_look& look) {
    if (look.index < 3) return vq2IndexBits;
    return vq2IndexBits + (look.quadrant > 0 ? vq2TransformBits : 0) + vq2WordBits;
}

}  // namespace

Vq2Block pack(const Vq2& map) {
    Vq2Block block{};
    for (unsigned row = 0; row < 8; ++row) {
        Packed indices;
        for (unsigned x = 0; x < 8; ++x) indices.put(map.indices[8 * row + x], 3);
        for (size_t k = 0; k < indexRowBytes; ++k) {
            block[indexRowBytes * row + k] = static_cast<uint8_t>(indices.bits >> (8 * k));
        }
    }
    assert(map.transforms[0] == 0);
    Packed book;
    for (unsigned quadrant = 1; quadrant < 4; ++quadrant) book.put(map.transforms[quadrant], 3);
    for (const Word2 word : map.shared) book.put(word, 5);
    for (const auto& pair : map.own) {
        for (const Word2 word : pair) book.put(word, 5);
    }
    storeLe(block.data() + bookStart, book.bits);
    return block;
}

Vq2 unpackVq2(Vq2View block) {
    Vq2 map;
    for (unsigned row = 0; row < 8; ++row) {
        Fields indices{loadLe<uint32_t>(block.data() + indexRowBytes * row)};
        for (unsigned x = 0; x < 8; ++x) map.indices[8 * row + x] = indices.take(3);
    }
    Fields book{loadLe<uint64_t>(block.data() + bookStart)};
    for (unsigned quadrant = 1; quadrant < 4; ++quadrant) map.transforms[quadrant] = book.take(3);
    for (Word2& word : map.shared) word = book.take(5);
    for (auto& pair : map.own) {
        for (Word2& word : pair) word = book.take(5);
    }
    return map;
}

Region vq2Region(Vq2View block, unsigned x, unsigned y) {
    assert(x < vq2Side && y < vq2Side);
    return static_cast<Region>(filigree_vq2_region(block.data(), x, y));
}

Region vq2PlusRegion(Vq2View block, unsigned x, unsigned y) {
    assert(x < vq2Side && y < vq2Side);
    return static_cast<Region>(filigree_vq2_plus_region(block.data(), x, y));
}

Vq2PlusReading vq2PlusReading(const Vq2& map, unsigned quadrant) {
    const auto [first, second] = map.own[quadrant];
    const filigree_vq2_plus_reading reading =
        filigree_vq2_plus_reading_(first, second, map.shared[1], map.shared[2]);
    return {reading.rereads != 0, static_cast<uint8_t>(reading.index),
            static_cast<Transform>(reading.rotation)};
}

unsigned vq2BitsRead(Vq2View block, unsigned x, unsigned y) {
    return bitsOf(filigree_vq2_look_(block.data(), x, y));
}

unsigned vq2PlusBitsRead(Vq2View block, unsigned x, unsigned y) {
    const filigree_vq2_look look = filigree_vq2_look_(block.data(), x, y);
    if (look.index != 0 && look.index != 2) return bitsOf(look);
    const filigree_vq2_plus_reading reading = filigree_vq2_plus_reading_at_(&look);
    const unsigned bits = vq2IndexBits + 2 * vq2WordBits;
    if (reading.rereads == 0 || look.index != reading.index) return bits;
    return bits + 3 * vq2WordBits + (look.quadrant > 0 ? vq2TransformBits : 0);
}

}  // namespace filigree::quadmap
