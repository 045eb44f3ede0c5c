// What tree and indexed-tree write, bit by bit, and what they refuse.
#include "filigree/encoding/tree.h"

#include "filigree/encoding/indexed_tree.h"

#include "encoding/sample_maps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace filigree::encoding {
namespace {

using micromap::Format;
using micromap::QuadtreeView;
using micromap::State;
using testing::ElementsAre;
using testing::HasSubstr;
using Bytes = std::vector<uint8_t>;

EncodedSet encodeOne(Encoding encoding, const QuadtreeView& map, Format format) {
    auto set = encode(encoding, std::span(&map, 1), format, {}, serialExecutor());
    EXPECT_TRUE(set.ok());
    return std::move(*set);
}

// Level 2, transparent but for micro-triangle 6, the third of child 1.
micromap::Quadtree smallMap(State odd) {
    return tests::oddOne(2, 6, State::transparent, odd);
}

TEST(Tree, WritesStructureThenValues) {
    const auto map = smallMap(State::unknownTransparent);
    const EncodedSet set = encodeOne(Encoding::tree, map.view(), Format::fourState);
    // Root 1, child 0 is a leaf, child 1 inner with four leaves, then two leaves: 1 0 1 0000 0 0.
    // Values: leaf 3 of 7 is 2.
    EXPECT_THAT(set.payload, ElementsAre(0b101, 0, 0b10000000, 0));
    EXPECT_THAT(set.descriptors, ElementsAre(0, 0, 0, 0, 2, 0, 0, 2));
}

TEST(Tree, MergesWhatTwoStatesMakeAlike) {
    const auto map = smallMap(State::unknownTransparent);
    const EncodedSet set = encodeOne(Encoding::tree, map.view(), Format::twoState);
    EXPECT_THAT(set.payload, ElementsAre(0, 0));
    EXPECT_THAT(set.descriptors, ElementsAre(0, 0, 0, 0, 0, 0, 0, 2));
}

TEST(Tree, AlternatingStatesTakeSevenThirdsOfFlat) {
    const auto map = tests::checkerboard(6, State::transparent, State::opaque);
    const EncodedSet set = encodeOne(Encoding::tree, map.view(), Format::twoState);
    EXPECT_EQ(set.payload.size(), (4 * 1365 + 1 + 7) / 8 + 4096 / 8);
}

void expectRefused(EncodedSet set, const Bytes& payload, const char* message) {
    set.payload = payload;
    const auto reader = TreeReader::open(viewOf(set));
    ASSERT_FALSE(reader.ok());
    EXPECT_THAT(reader.error().message, HasSubstr(message));
}

TEST(Tree, SaysWhatIsWrong) {
    const auto map = smallMap(State::unknownTransparent);
    const EncodedSet set = encodeOne(Encoding::tree, map.view(), Format::fourState);
    expectRefused(set, {0b101, 0, 0, 0}, "four siblings of one state");
    expectRefused(set, {0b101, 0, 0b10000000, 0b01000000}, "spare bits");
    expectRefused(set, {0b101, 0b10, 0b10000000, 0}, "spare bits");
    expectRefused(set, {0b1101, 0, 0b10000000, 0}, "inner node at the finest level");
    expectRefused(set, {0b1, 0, 0b10000000, 0}, "goes on behind the tree");
    expectRefused(set, {0b10000001, 0b1, 0b10000000, 0}, "goes on behind the tree");
    expectRefused(set, {0b10000101, 0, 0b10000000, 0}, "ends within the tree");
    expectRefused(set, {0b101, 0, 0b10000000}, "map 0 needs bytes 0 to 4");
}

TEST(IndexedTree, HoldsTheBitsOfTreeAndEvery64thLeaf) {
    const auto map = tests::checkerboard(5, State::transparent, State::opaque);
    const EncodedSet tree = encodeOne(Encoding::tree, map.view(), Format::fourState);
    const EncodedSet indexed = encodeOne(Encoding::indexedTree, map.view(), Format::fourState);
    EXPECT_EQ(indexed.descriptors, tree.descriptors);
    Bytes expected = tree.payload;
    for (unsigned leaf = 64; leaf < 1024; leaf += 64) {
        expected.push_back(static_cast<uint8_t>(leaf));
        expected.push_back(static_cast<uint8_t>(leaf >> 8));
    }
    expected.insert(expected.end(), 8, 0);
    EXPECT_EQ(indexed.payload, expected);
}

TEST(IndexedTree, RefusesADirectoryOfAnotherTree) {
    const auto map = tests::checkerboard(5, State::transparent, State::opaque);
    EncodedSet set = encodeOne(Encoding::indexedTree, map.view(), Format::fourState);
    set.payload[set.payload.size() - 10] ^= 1;
    const auto reader = IndexedTreeReader::open(viewOf(set));
    ASSERT_FALSE(reader.ok());
    EXPECT_THAT(reader.error().message, HasSubstr("directory of another tree"));
}

TEST(IndexedTree, TakesNoMoreThanThePaperExpects) {
    std::mt19937 random(21);
    for (const unsigned level : {7u, 8u, 9u, 10u}) {
        const auto map = tests::noise(level, 0.2, random);
        for (const Format format : {Format::twoState, Format::fourState}) {
            const auto tree = encodeOne(Encoding::tree, map.view(), format).payload.size();
            const auto indexed = encodeOne(Encoding::indexedTree, map.view(), format).payload.size();
            EXPECT_LT(static_cast<double>(indexed - tree), 0.265 * static_cast<double>(tree) + 8);
        }
    }
}

}  // namespace
}  // namespace filigree::encoding
