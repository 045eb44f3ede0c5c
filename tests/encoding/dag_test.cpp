#include "filigree/encoding/dag.h"

#include "filigree/core/bytes.h"

#include "encoding/dag_layout.h"
#include "encoding/reader_of.h"
#include "encoding/sample_maps.h"

#include <gtest/gtest.h>

namespace filigree::encoding {
namespace {

using micromap::Format;
using micromap::Quadtree;
using micromap::QuadtreeView;
using micromap::State;

EncodedSet encodeMaps(std::initializer_list<Quadtree> maps, Format format) {
    std::vector<QuadtreeView> views;
    for (const Quadtree& map : maps) views.push_back(map.view());
    auto set = encodeDag(views, format, serialExecutor());
    EXPECT_TRUE(set.ok());
    return set.ok() ? *set : EncodedSet{};
}

std::vector<uint32_t> wordsOf(const EncodedSet& set) {
    std::vector<uint32_t> words(set.payload.size() / 4);
    for (size_t k = 0; k < words.size(); ++k) words[k] = loadLe<uint32_t>(set.payload.data() + 4 * k);
    return words;
}

void setWords(EncodedSet& set, const std::vector<uint32_t>& words) {
    set.payload.resize(4 * words.size());
    for (size_t k = 0; k < words.size(); ++k) storeLe(set.payload.data() + 4 * k, words[k]);
}

std::string errorOf(const EncodedSet& set) {
    const auto reader = DagReader::open(viewOf(set));
    return reader.ok() ? "" : reader.error().message;
}

// Level 6, one opaque micro-triangle, index 0x123: child 1 of the root, block 2 of the leaf, state 3.
EncodedSet oneOpaque() {
    return encodeMaps({tests::oddOne(6, 0x123, State::transparent, State::opaque)}, Format::twoState);
}

TEST(Dag, WritesTheWordsOfThePage) {
    const EncodedSet set = oneOpaque();
    const uint32_t leafShare = 256;  // 65535 / 256, to nearest
    const uint32_t rootShare = 16;
    EXPECT_EQ(wordsOf(set),
              (std::vector<uint32_t>{leafShare << 16 | 1 << 2, 1 << 3, rootShare << 16 | 1 << 1, 0}));
    EXPECT_EQ(loadLe<uint32_t>(set.descriptors.data()), 6u << 28 | 2);
}

TEST(Dag, PadsOddAndSmallLevels) {
    const EncodedSet set = encodeMaps({tests::oddOne(5, 1023, State::transparent, State::opaque),
                                       tests::oddOne(0, 0, State::opaque, State::opaque),
                                       tests::oddOne(3, 0, State::transparent, State::transparent)},
                                      Format::fourState);
    const std::vector<uint32_t> expected{256u << 16 | 1 << 15,
                                         1u << 30,  // leaf of map 0
                                         16u << 16 | 1 << 3,
                                         0,  // its root: a quarter of level 6
                                         256u << 16 | 1,
                                         1u,  // map 1
                                         0};  // map 2, nothing in it
    EXPECT_EQ(wordsOf(set), expected);
    EXPECT_EQ(errorOf(set), "");
}

TEST(Dag, StoresEqualSubtreesOnce) {
    const Quadtree map = tests::disc(9, 0.6);
    const EncodedSet once = encodeMaps({map}, Format::fourState);
    const EncodedSet twice = encodeMaps({map, map}, Format::fourState);
    EXPECT_EQ(once.payload, twice.payload);
    // A uniform map of level 12 is one node at each of five heights.
    const EncodedSet uniform =
        encodeMaps({tests::oddOne(12, 0, State::opaque, State::opaque)}, Format::fourState);
    EXPECT_EQ(uniform.payload.size(), 5u * 17 * 4);
}

// More than is built at once, with subtrees that recur far apart.
TEST(Dag, ManyChunksGiveTheBytesOfOneThread) {
    std::mt19937 random(11);
    std::vector<Quadtree> maps;
    for (unsigned k = 0; k < 12; ++k) maps.push_back(tests::noise(8 + k % 2, 0.05, random));
    for (unsigned k = 0; k < 12; ++k) maps.push_back(maps[k]);
    std::vector<QuadtreeView> views;
    for (const Quadtree& map : maps) views.push_back(map.view());
    const auto serial = encodeDag(views, Format::fourState, serialExecutor());
    const auto threaded = encodeDag(views, Format::fourState, *makeThreadedExecutor(2));
    ASSERT_TRUE(serial.ok() && threaded.ok());
    EXPECT_EQ(serial->payload, threaded->payload);
    EXPECT_EQ(serial->descriptors, threaded->descriptors);
    const auto reader = DagReader::open(viewOf(*serial));
    ASSERT_TRUE(reader.ok()) << reader.error().message;
    for (uint32_t k = 0; k < maps.size(); ++k)
        EXPECT_TRUE(micromap::equal(reader->decode(k).view(), views[k]));
    EXPECT_EQ(serial->payload,
              encodeDag(std::span(views).first(12), Format::fourState, serialExecutor())->payload);
}

TEST(Dag, SharesAgreeWithCounts) {
    for (const Format format : {Format::twoState, Format::fourState}) {
        std::mt19937 random(5);
        for (unsigned level = 0; level <= 9; ++level) {
            const EncodedSet set =
                encodeMaps({tests::noise(level, 0.3, random), tests::disc(level, 0.7)}, format);
            const auto reader = DagReader::open(viewOf(set));
            ASSERT_TRUE(reader.ok()) << reader.error().message;
            for (unsigned coarse = 0; coarse <= level; ++coarse) {
                const auto count = static_cast<uint32_t>(micromap::microTriangleCount(coarse));
                for (uint32_t k = 0; k < 2 * count; k += 1 + count / 64) {
                    ASSERT_NEAR(reader->opaqueShare(k / count, k % count, coarse),
                                countedShare(*reader, k / count, k % count, coarse), 1.0 / 65535)
                        << "level " << level << " at " << coarse << ", part " << k;
                }
            }
        }
    }
}

TEST(Dag, RefusesReferencesThatDoNotPointBack) {
    EncodedSet set = oneOpaque();
    auto words = wordsOf(set);
    for (const uint32_t pointer : {2u, 3u, 4u, 0xffffffffu}) {
        words[3] = pointer;
        setWords(set, words);
        EXPECT_EQ(errorOf(set),
                  "payload: byte 12: pointer to word " + std::to_string(pointer) + ", expected below 2");
    }
    words[3] = 1;
    setWords(set, words);
    EXPECT_NE(errorOf(set), "");
}

TEST(Dag, RefusesANodeReadAtTwoHeights) {
    EncodedSet set = oneOpaque();
    storeLe(set.descriptors.data(), 8u << 28 | 2);
    EXPECT_NE(errorOf(set), "");
    set = encodeMaps({tests::oddOne(6, 0x123, State::transparent, State::opaque),
                      tests::oddOne(4, 0, State::transparent, State::opaque)},
                     Format::twoState);
    storeLe(set.descriptors.data() + 4, 4u << 28 | 2);
    EXPECT_EQ(errorOf(set), "descriptors: map 1: root 2 has height 4, an earlier map reads it as 6");
}

TEST(Dag, RefusesWrongSharesAndSpareBits) {
    EncodedSet set = oneOpaque();
    const auto good = wordsOf(set);
    auto words = good;
    words[2] += 1u << 16;
    setWords(set, words);
    EXPECT_EQ(errorOf(set), "payload: byte 8: opaque share 17, expected 16");
    words = good;
    words[1] |= 1u << 16;
    setWords(set, words);
    EXPECT_EQ(errorOf(set), "payload: byte 6: padding 0x1, expected 0");
    words = good;
    words[1] = 0;
    setWords(set, words);
    EXPECT_EQ(errorOf(set), "payload: byte 4: a mask without a set bit, expected an absent child");
}

TEST(Dag, RefusesMoreThanALevelHas) {
    EncodedSet set = encodeMaps({tests::oddOne(4, 16, State::transparent, State::opaque)}, Format::twoState);
    for (unsigned level = 0; level <= 2; ++level) {
        storeLe(set.descriptors.data(), level << 28);
        EXPECT_EQ(errorOf(set), "payload: byte 0: the root of map 0 holds more than level " +
                                    std::to_string(level) + " has");
    }
    set = encodeMaps({tests::oddOne(2, 15, State::transparent, State::opaque)}, Format::fourState);
    storeLe(set.descriptors.data(), 1u << 28);
    EXPECT_NE(errorOf(set), "");
}

TEST(Dag, RefusesNodesThatNobodyReaches) {
    EncodedSet set = oneOpaque();
    auto words = wordsOf(set);
    words.push_back(0);
    setWords(set, words);
    EXPECT_NE(errorOf(set), "");
    storeLe(set.descriptors.data(), 6u << 28 | 4);
    EXPECT_EQ(errorOf(set), "payload: bytes 0 to 16 belong to no node");
}

}  // namespace
}  // namespace filigree::encoding
