#include "filigree/quadmap/vq2.h"

#include "filigree/core/bytes.h"

#include "quadmap/fields.h"

namespace filigree::quadmap {
namespace {

constexpr size_t indexRowBytes = 3;
constexpr size_t bookStart = 24;

Region regionIn(Word2 word, Cell cell) {
    if ((word >> (2 * cell.y + cell.x) & 1) == 0) return Region::mixed;
    return (word >> 4 & 1) != 0 ? Region::opaque : Region::transparent;
}

struct Place {
    unsigned vector;
    unsigned quadrant;
    Cell inVector;
};

Place placeOf(unsigned x, unsigned y) {
    assert(x < vq2Side && y < vq2Side);
    return {y / 2 * 8 + x / 2, y / 8 * 2 + x / 8, {x % 2, y % 2}};
}

Region indexedRegion(const Vq2& map, const Place& place, unsigned index) {
    if (index < 3) return static_cast<Region>(index);
    const Word2 word = index < 6 ? map.shared[index - 3] : map.own[place.quadrant][index - 6];
    return regionIn(word, storedCell(map.transforms[place.quadrant], 2, place.inVector));
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
    const Vq2 map = unpackVq2(block);
    const Place place = placeOf(x, y);
    return indexedRegion(map, place, map.indices[place.vector]);
}

Vq2PlusReading vq2PlusReading(const Vq2& map, unsigned quadrant) {
    const auto [first, second] = map.own[quadrant];
    Vq2PlusReading reading;
    reading.rereads = first > second;
    reading.index = ((first ^ second) & 1) != 0 ? 2 : 0;
    reading.rotation = map.shared[1] > map.shared[2] ? 6 : 1;
    return reading;
}

Region vq2PlusRegion(Vq2View block, unsigned x, unsigned y) {
    const Vq2 map = unpackVq2(block);
    const Place place = placeOf(x, y);
    const unsigned index = map.indices[place.vector];
    const Vq2PlusReading reading = vq2PlusReading(map, place.quadrant);
    if (!reading.rereads || index != reading.index) return indexedRegion(map, place, index);
    const Cell rotated = storedCell(map.transforms[place.quadrant], 2, place.inVector);
    return regionIn(map.shared[0], storedCell(reading.rotation, 2, rotated));
}

}  // namespace filigree::quadmap
