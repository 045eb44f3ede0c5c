// What lookups read, as docs/spec/bits-read.md counts it.
#include "encoding/sample_maps.h"

#include <gtest/gtest.h>

namespace filigree::encoding {
namespace {

using micromap::Format;
using micromap::State;

// Of all micro-triangles of one map.
uint64_t totalRead(Encoding encoding, const micromap::Quadtree& map, Format format) {
    tests::SampleSet set;
    set.maps.push(map.view());
    const EncodedSet encoded = tests::encodeGood(encoding, set, format);
    const auto reader = tests::openGood(viewOf(encoded));
    uint64_t total = 0;
    for (uint32_t k = 0; k < micromap::microTriangleCount(map.view().level); ++k)
        total += reader->bitsRead(0, k);
    return total;
}

double meanRead(Encoding encoding, const micromap::Quadtree& map, Format format = Format::fourState) {
    return static_cast<double>(totalRead(encoding, map, format)) /
           static_cast<double>(micromap::microTriangleCount(map.view().level));
}

TEST(BitsRead, IsConstantWhereStatesStandAtFixedPlaces) {
    for (const unsigned level : {0u, 3u, 6u}) {
        for (const Encoding encoding : {Encoding::flat, Encoding::gruen}) {
            EXPECT_EQ(meanRead(encoding, tests::disc(level, 0.5)), 66);
            EXPECT_EQ(meanRead(encoding, tests::disc(level, 0.5), Format::twoState), 65);
        }
    }
}

// Level 1, child 2 alone opaque: the descriptor, 64, the value, 2, and structure bits 10 000.
TEST(BitsRead, CountsTheTreesScan) {
    tests::SampleSet set;
    const auto map = tests::oddOne(1, 2, State::transparent, State::opaque);
    set.maps.push(map.view());
    for (const Encoding encoding : {Encoding::tree, Encoding::indexedTree}) {
        const EncodedSet encoded = tests::encodeGood(encoding, set, Format::fourState);
        const auto reader = tests::openGood(viewOf(encoded));
        for (uint32_t k = 0; k < 4; ++k) EXPECT_EQ(reader->bitsRead(0, k), 64 + 2 + 2 + k);
    }
}

TEST(BitsRead, GrowsWithTheTreeButLittleWithADirectory) {
    double tree = 0;
    for (const unsigned level : {3u, 5u, 7u, 9u}) {
        const auto map = tests::disc(level, 0.6);
        const double more = meanRead(Encoding::tree, map);
        EXPECT_GT(more, 1.2 * tree);
        tree = more;
        EXPECT_LE(meanRead(Encoding::indexedTree, map), tree + 8 * 3 * level);
    }
    EXPECT_GT(tree, 1000);
    EXPECT_LT(meanRead(Encoding::indexedTree, tests::disc(9, 0.6)), 500);
}

// Two nodes, then a leaf's head and mask: the descriptor, two pairs of words.
TEST(BitsRead, CountsWordsOfTheDag) {
    const auto map = tests::oddOne(6, 0x123, State::transparent, State::opaque);
    tests::SampleSet set;
    set.maps.push(map.view());
    const EncodedSet encoded = tests::encodeGood(Encoding::dag, set, Format::twoState);
    const auto reader = tests::openGood(viewOf(encoded));
    EXPECT_EQ(reader->bitsRead(0, 0x123), 5u * 32);
    EXPECT_EQ(reader->bitsRead(0, 0x133), 4u * 32);  // another block of the leaf
    EXPECT_EQ(reader->bitsRead(0, 0xfff), 2u * 32);  // another child of the root
}

// Never more than a head, a code and a pattern below two levels a node.
TEST(BitsRead, IsBoundedForTheSdag) {
    for (const auto& set : tests::sampleSets()) {
        for (const Format format : {Format::twoState, Format::fourState}) {
            const EncodedSet encoded = tests::encodeGood(Encoding::sdag, set, format);
            const auto reader = tests::openGood(viewOf(encoded));
            for (uint32_t map = 0; map < reader->mapCount(); ++map) {
                const uint64_t count = micromap::microTriangleCount(reader->level(map));
                for (uint64_t k = 0; k < count; k += 1 + count / 1000) {
                    const uint64_t bits = reader->bitsRead(map, static_cast<uint32_t>(k));
                    EXPECT_GT(bits, 0u);
                    EXPECT_LE(bits, 40 + 4 * 64 + 32 + 48 + 16 * 8 + 40u);
                }
            }
        }
    }
}

}  // namespace
}  // namespace filigree::encoding
