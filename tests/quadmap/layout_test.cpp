// The pages docs/spec/vq2.md and vq4.md, and the facts that the formats rest on.
#include "filigree/core/target.h"
#include "filigree/quadmap/reader.h"
#include "filigree/quadmap/vq2.h"
#include "filigree/quadmap/vq4.h"

#include "sample_squares.h"

#include <set>

#include <gtest/gtest.h>

namespace filigree::quadmap {
namespace {

// No 2 x 2 window of an n x n vector holds both states (section 2 of the paper): counted row by row.
uint64_t continuousVectors(unsigned n) {
    unsigned rows = 1;
    for (unsigned k = 0; k < n; ++k) rows *= 3;
    const auto value = [](unsigned row, unsigned x) {
        for (; x > 0; --x) row /= 3;
        return row % 3;
    };
    const auto clash = [](std::initializer_list<unsigned> window) {
        const auto has = [&](unsigned state) { return std::ranges::find(window, state) != window.end(); };
        return has(0) && has(2);
    };
    std::vector<uint64_t> ways(rows, 1);
    for (unsigned y = 1; y < n; ++y) {
        std::vector<uint64_t> next(rows, 0);
        for (unsigned above = 0; above < rows; ++above) {
            for (unsigned below = 0; below < rows; ++below) {
                bool fine = true;
                for (unsigned x = 0; x + 1 < n && fine; ++x) {
                    fine =
                        !clash({value(above, x), value(above, x + 1), value(below, x), value(below, x + 1)});
                }
                if (fine) next[below] += ways[above];
            }
        }
        ways = std::move(next);
    }
    uint64_t sum = 0;
    for (const uint64_t way : ways) sum += way;
    return sum;
}

TEST(Vectors, AreAsManyAsThePaperSays) {
    EXPECT_EQ(continuousVectors(2), 31u);
    EXPECT_EQ(continuousVectors(4), 231713u);
}

TEST(Transforms, AreThoseOfTable1) {
    // A letter F: left column, top row, a middle bar.
    const Cell corner{0, 0};
    const auto shownAt = [&](Transform transform) {
        for (unsigned y = 0; y < 4; ++y) {
            for (unsigned x = 0; x < 4; ++x) {
                const Cell from = storedCell(transform, 4, {x, y});
                if (from.x == 1 && from.y == corner.y) return std::pair(x, y);
            }
        }
        return std::pair(9U, 9U);
    };
    // Where the cell right of the top left corner goes.
    EXPECT_EQ(shownAt(0), std::pair(1U, 0U));
    EXPECT_EQ(shownAt(1), std::pair(0U, 2U));  // anticlockwise: the top row becomes the left column
    EXPECT_EQ(shownAt(2), std::pair(1U, 3U));
    EXPECT_EQ(shownAt(3), std::pair(0U, 1U));
    EXPECT_EQ(shownAt(4), std::pair(2U, 0U));
    EXPECT_EQ(shownAt(5), std::pair(3U, 2U));
    EXPECT_EQ(shownAt(6), std::pair(2U, 3U));
    EXPECT_EQ(shownAt(7), std::pair(3U, 1U));
}

TEST(Transforms, AreAGroup) {
    for (Transform a = 0; a < transformCount; ++a) {
        EXPECT_EQ(compose(a, inverse(a)), 0);
        for (Transform b = 0; b < transformCount; ++b) {
            EXPECT_EQ(transformedCells(compose(a, b), 4, 0x1234),
                      transformedCells(a, 4, transformedCells(b, 4, 0x1234)));
        }
    }
}

template <class Block>
Block randomBlock(std::mt19937& random) {
    Block block;
    for (uint8_t& byte : block) byte = static_cast<uint8_t>(random());
    return block;
}

// The pages' decoders, from unpacked fields.
Region readVq2(const Vq2& map, bool plus, unsigned x, unsigned y) {
    const unsigned quadrant = y / 8 * 2 + x / 8;
    const unsigned index = map.indices[y / 2 * 8 + x / 2];
    Cell cell = storedCell(map.transforms[quadrant], 2, {x % 2, y % 2});
    const Vq2PlusReading reading = vq2PlusReading(map, quadrant);
    Word2 word = index < 3 ? Word2{0} : index < 6 ? map.shared[index - 3] : map.own[quadrant][index - 6];
    if (plus && reading.rereads && index == reading.index) {
        word = map.shared[0];
        cell = storedCell(reading.rotation, 2, cell);
    } else if (index < 3) {
        return static_cast<Region>(index);
    }
    if ((word >> (2 * cell.y + cell.x) & 1) == 0) return Region::mixed;
    return word >= 16 ? Region::opaque : Region::transparent;
}

Region readVq4(const Vq4& map, Vq4Layout layout, unsigned x, unsigned y) {
    const unsigned index = map.indices[y / 4 * 8 + x / 4];
    if (index < 3) return static_cast<Region>(index);
    const Cell cell = storedCell(map.transforms[groupOf(layout, x / 4, y / 4)], 4, {x % 4, y % 4});
    const Word4& word = map.words[index - 3];
    if ((word.known >> (4 * cell.y + cell.x) & 1) == 0) return Region::mixed;
    return (word.palettes >> (cell.y / 2 * 2 + cell.x / 2) & 1) != 0 ? Region::opaque : Region::transparent;
}

TEST(Vq2, EveryPatternIsAMap) {
    std::mt19937 random(1);
    for (int k = 0; k < 200; ++k) {
        const auto block = randomBlock<Vq2Block>(random);
        const Vq2 map = unpackVq2(block);
        EXPECT_EQ(pack(map), block);
        for (unsigned at = 0; at < 256; ++at) {
            ASSERT_EQ(vq2Region(block, at % 16, at / 16), readVq2(map, false, at % 16, at / 16));
            ASSERT_EQ(vq2PlusRegion(block, at % 16, at / 16), readVq2(map, true, at % 16, at / 16));
        }
    }
}

TEST(Vq4, EveryPatternIsAMap) {
    std::mt19937 random(2);
    for (int k = 0; k < 200; ++k) {
        const auto block = randomBlock<Vq4Block>(random);
        for (const Vq4Layout layout : {Vq4Layout::vq4, Vq4Layout::vq4Plus}) {
            const Vq4 map = unpackVq4(block, layout);
            EXPECT_EQ(pack(map, layout), block);
            for (unsigned at = 0; at < 1024; ++at) {
                ASSERT_EQ(vq4Region(block, layout, at % 32, at / 32), readVq4(map, layout, at % 32, at / 32));
            }
        }
    }
}

// One bit at a time, at the places that the pages name.
TEST(Vq2, BitsStandWhereThePageSays) {
    Vq2Block block{};
    block[3 * 2] = 7 << 3;  // row 2, column 1
    EXPECT_EQ(unpackVq2(block).indices[17], 7);
    block = {};
    block[24] = 1 << 3;  // bit 195
    EXPECT_EQ(unpackVq2(block).transforms[2], 1);
    block = {};
    block[25] = 1 << 1;  // bit 201
    EXPECT_EQ(unpackVq2(block).shared[0], 1);
    block = {};
    block[31] = 0x80;
    EXPECT_EQ(unpackVq2(block).own[3][1], 16);
}

TEST(Vq4, BitsStandWhereThePagesSay) {
    const auto bit = [](unsigned place) {
        Vq4Block block{};
        block[place / 8] = static_cast<uint8_t>(1U << (place % 8));
        return block;
    };
    EXPECT_EQ(unpackVq4(bit(4 * 9), Vq4Layout::vq4).indices[9], 1);
    EXPECT_EQ(unpackVq4(bit(256 + 16 * 12), Vq4Layout::vq4).words[12].known, 1);
    EXPECT_EQ(unpackVq4(bit(464), Vq4Layout::vq4).transforms[1], 1);
    EXPECT_EQ(unpackVq4(bit(473), Vq4Layout::vq4).words[0].palettes, 15);
    EXPECT_EQ(unpackVq4(bit(477), Vq4Layout::vq4).words[3].palettes, 0b1010);
    EXPECT_EQ(unpackVq4(bit(479), Vq4Layout::vq4).words[4].palettes, 0b1100);
    EXPECT_EQ(unpackVq4(bit(480), Vq4Layout::vq4).words[5].palettes, 1);
    EXPECT_EQ(unpackVq4(bit(464), Vq4Layout::vq4Plus).transforms[0], 1);
    EXPECT_EQ(unpackVq4(bit(488), Vq4Layout::vq4Plus).words[0].palettes, 1);
    EXPECT_EQ(unpackVq4(bit(501), Vq4Layout::vq4Plus).words[3].palettes, 0b1010);
    EXPECT_EQ(unpackVq4(bit(502), Vq4Layout::vq4Plus).words[4].palettes, 0b0011);
    EXPECT_EQ(unpackVq4(bit(504), Vq4Layout::vq4Plus).words[5].palettes, 15);
}

struct Hits {
    std::vector<uint32_t> maps;
    std::vector<Half> halves;
    std::vector<float> u, v;

    Hits(size_t count, size_t mapCount, std::mt19937& random) {
        const std::array<float, 6> odd{-1.0F, 0.0F, 1.0F, 2.0F, 0.5F, std::nanf("")};
        for (size_t k = 0; k < count; ++k) {
            maps.push_back(static_cast<uint32_t>(random() % mapCount));
            halves.push_back(static_cast<Half>(random() % 2));
            u.push_back(k % 16 == 0 ? odd[random() % 6] : static_cast<float>(random() % 65536) / 65536);
            v.push_back(k % 16 == 1 ? odd[random() % 6] : static_cast<float>(random() % 65536) / 65536);
        }
    }
};

TEST(SquareReader, CountsTheBitsThatItReads) {
    Vq2 small;
    small.indices[0] = 1;
    small.indices[1] = small.indices[4] = 3;
    small.indices[5] = 2;
    small.own[1] = {2, 1};  // read anew
    small.shared = {0, 1, 2};
    const Vq2Block vq2 = pack(small);
    EXPECT_EQ(vq2BitsRead(vq2, 0, 0), 3u);
    EXPECT_EQ(vq2BitsRead(vq2, 2, 0), 3u + 5);
    EXPECT_EQ(vq2BitsRead(vq2, 8, 0), 3u + 3 + 5);
    EXPECT_EQ(vq2PlusBitsRead(vq2, 0, 0), 3u);
    EXPECT_EQ(vq2PlusBitsRead(vq2, 8, 0), 3u + 3 + 5);
    EXPECT_EQ(vq2PlusBitsRead(vq2, 4, 0), 3u + 10);
    EXPECT_EQ(vq2PlusBitsRead(vq2, 10, 0), 3u + 10 + 15 + 3);
    Vq4 large;
    large.indices[0] = large.indices[4] = 5;
    for (const Vq4Layout layout : {Vq4Layout::vq4, Vq4Layout::vq4Plus}) {
        const Vq4Block vq4 = pack(large, layout);
        const unsigned first = layout == Vq4Layout::vq4 ? 0 : 3;
        EXPECT_EQ(vq4BitsRead(vq4, layout, 4, 0), 4u);
        EXPECT_EQ(vq4BitsRead(vq4, layout, 0, 0), 4 + first + 16 + 1);
        EXPECT_EQ(vq4BitsRead(vq4, layout, 16, 0), 4u + 3 + 16 + 1);
    }
}

TEST(SquareReader, BatchesAreTheSameOnEachTarget) {
    std::mt19937 random(3);
    for (unsigned f = 0; f < squareFormatCount; ++f) {
        const auto format = static_cast<SquareFormat>(f);
        std::vector<uint8_t> bytes(40 * blockBytesOf(format));
        for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(random());
        if (format == SquareFormat::raw16 || format == SquareFormat::raw32) {
            for (uint8_t& byte : bytes) byte &= static_cast<uint8_t>(~(byte >> 1 & 0x55U));
        }
        const auto reader = SquareReader::open(format, bytes);
        ASSERT_TRUE(reader.ok());
        const Hits hits(2003, reader->mapCount(), random);
        for (const char* target : {"scalar", "sse4", "avx2", "avx3", "best"}) {
            if (!forceTarget(target).ok()) continue;
            std::vector<Region> regions(hits.maps.size());
            reader->lookup(hits.maps, hits.halves, hits.u, hits.v, regions);
            for (size_t k = 0; k < regions.size(); ++k) {
                ASSERT_EQ(regions[k], reader->at(hits.maps[k], hits.halves[k], hits.u[k], hits.v[k]))
                    << nameOf(format) << " on " << target << " at " << k;
            }
        }
        EXPECT_TRUE(forceTarget("best").ok());
    }
}

TEST(SquareReader, RefusesWhatIsNoArrayOfMaps) {
    for (unsigned f = 0; f < squareFormatCount; ++f) {
        const auto format = static_cast<SquareFormat>(f);
        const size_t size = blockBytesOf(format);
        for (size_t bytes = 0; bytes <= 2 * size + 1; ++bytes) {
            const std::vector<uint8_t> some(bytes);
            EXPECT_EQ(SquareReader::open(format, some).ok(), bytes % size == 0);
        }
    }
    std::vector<uint8_t> raw(64);
    raw[7] = 0x0c;
    EXPECT_EQ(SquareReader::open(SquareFormat::raw16, raw).error().message,
              "raw16 map 0: byte 7 holds a region of value 3, expected 0 to 2");
}

TEST(SquareReader, PutsBothTrianglesInTheSquare) {
    Square square(16, Region::mixed);
    square.at(0, 0) = Region::transparent;
    square.at(15, 15) = Region::opaque;
    std::vector<uint8_t> raw(64);
    encodeRaw(square, raw);
    const auto reader = SquareReader::open(SquareFormat::raw16, raw);
    EXPECT_EQ(reader->at(0, Half::first, 0, 0), Region::transparent);
    EXPECT_EQ(reader->at(0, Half::second, 0, 0), Region::opaque);
    EXPECT_EQ(reader->at(0, Half::first, 0.1F, 0), Region::mixed);
    EXPECT_EQ(reader->decode(0), square);
}

}  // namespace
}  // namespace filigree::quadmap
