#include "filigree/quadmap/vq2.h"

#include "filigree/core/bytes.h"

#include "quadmap/fields.h"

namespace filigree::quadmap {
namespace {

constexpr size_t indexRowBytes = 3;
constexpr size_t bookStart = 24;

Region regionIn(Word2 word, Cell cell) {
    const unsigned known = word >> (2 * cell.y + cell.x) & 1U;
    const unsigned palette = word >> 4 & 1U;
    // 1 for mixed, else 0 or 2.
    return static_cast<Region>(1 - known + 2 * (known & palette));
}

// What a block's last 8 bytes say of one region.
struct Looked {
    uint64_t book;
    unsigned index;
    unsigned quadrant;
    Cell cell;  // of the stored vector

    Looked(Vq2View block, unsigned x, unsigned y)
        : book(loadLe<uint64_t>(block.data() + bookStart)),
          index(loadLe<uint32_t>(block.data() + indexRowBytes * (y / 2)) >> (3 * (x / 2)) & 7),
          quadrant(y / 8 * 2 + x / 8),
          cell(storedCell(static_cast<Transform>((book & 511) << 3 >> (3 * quadrant) & 7), 2,
                          {x % 2, y % 2})) {
        assert(x < vq2Side && y < vq2Side);
    }

    [[nodiscard]] Word2 shared(unsigned k) const { return book >> (9 + 5 * k) & 31; }
    [[nodiscard]] Word2 own(unsigned k) const { return book >> (24 + 10 * quadrant + 5 * k) & 31; }
    // Without branches, since indices follow no pattern.
    [[nodiscard]] Region region() const {
        const unsigned place = 5 * index - 6 + (index >= 6 ? 10 * quadrant : 0);
        const auto word = static_cast<Word2>(book >> (place & 63) & 31);
        return index < 3 ? static_cast<Region>(index) : regionIn(word, cell);
    }
};

constexpr unsigned vq2IndexBits = 3;
constexpr unsigned vq2TransformBits = 3;
constexpr unsigned vq2WordBits = 5;

// The index, and of a word its transform, which the first quadrant has none of, and the word.
unsigned bitsOf(const Looked& looked) {
    if (looked.index < 3) return vq2IndexBits;
    return vq2IndexBits + (looked.quadrant > 0 ? vq2TransformBits : 0) + vq2WordBits;
}

Vq2PlusReading readingOf(Word2 ownFirst, Word2 ownSecond, Word2 sharedSecond, Word2 sharedThird) {
    Vq2PlusReading reading;
    reading.rereads = ownFirst > ownSecond;
    reading.index = ((ownFirst ^ ownSecond) & 1) != 0 ? 2 : 0;
    reading.rotation = sharedSecond > sharedThird ? 6 : 1;
    return reading;
}

Vq2PlusReading readingOf(const Looked& looked) {
    return readingOf(looked.own(0), looked.own(1), looked.shared(1), looked.shared(2));
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
    return Looked(block, x, y).region();
}

Vq2PlusReading vq2PlusReading(const Vq2& map, unsigned quadrant) {
    const auto [first, second] = map.own[quadrant];
    return readingOf(first, second, map.shared[1], map.shared[2]);
}

unsigned vq2BitsRead(Vq2View block, unsigned x, unsigned y) {
    return bitsOf(Looked(block, x, y));
}

unsigned vq2PlusBitsRead(Vq2View block, unsigned x, unsigned y) {
    const Looked looked(block, x, y);
    if (looked.index != 0 && looked.index != 2) return bitsOf(looked);
    const auto reading = readingOf(looked);
    const unsigned bits = vq2IndexBits + 2 * vq2WordBits;
    if (!reading.rereads || looked.index != reading.index) return bits;
    return bits + 3 * vq2WordBits + (looked.quadrant > 0 ? vq2TransformBits : 0);
}

Region vq2PlusRegion(Vq2View block, unsigned x, unsigned y) {
    const Looked looked(block, x, y);
    const auto reading = readingOf(looked);
    if (!reading.rereads || looked.index != reading.index) return looked.region();
    return regionIn(looked.shared(0), storedCell(reading.rotation, 2, looked.cell));
}

}  // namespace filigree::quadmap
