#include "filigree/encoding/sdag.h"

#include "filigree/encoding/flat.h"

#include "encoding/reader_of.h"
#include "encoding/sample_maps.h"
#include "encoding/sdag_layout.h"

#include <gtest/gtest.h>

namespace filigree::encoding {
namespace {

using micromap::Format;
using micromap::Quadtree;
using micromap::QuadtreeView;
using micromap::State;

EncodedSet encodeMaps(const std::vector<Quadtree>& maps, Format format, bool shares = false) {
    std::vector<QuadtreeView> views;
    for (const Quadtree& map : maps) views.push_back(map.view());
    auto set = encodeSdag(views, format, shares, serialExecutor());
    EXPECT_TRUE(set.ok());
    return set.ok() ? *set : EncodedSet{};
}

uint64_t part(const SdagReader& reader, std::string_view name) {
    for (const Part& p : reader.parts()) {
        if (p.name == name) return p.bits / 8;
    }
    return 0;
}

// All opaque but one micro-triangle: a leaf with one head and one pattern, behind a node.
TEST(Sdag, WritesTheBytesOfThePage) {
    const EncodedSet set =
        encodeMaps({tests::oddOne(6, 0, State::opaque, State::transparent)}, Format::twoState);
    const sdag::Head head = sdag::readHead(set.descriptors);
    EXPECT_EQ(head.levels, 1u << 6);
    EXPECT_EQ(head.nodes[0], 1u);
    EXPECT_EQ(head.patterns, 0u);  // would not pay for one use
    EXPECT_EQ(head.heads, 1u);
    EXPECT_EQ(head.base_bytes, 1u);
    // Index 0 lies at vertex 0: digit (1, 1) on all levels, grandchild 15.
    std::vector<uint8_t> expected{0x00, 0x80, 0xff, 0x7f,  // the table's head
                                  0x00, 0x80, 0xff, 0x7f,  // the node's mixed and opaque
                                  0,                       // its base
                                  1,                       // the block: the leaf's offset,
                                  0,                       // the leaf: its head's code,
                                  255,  0xff, 0x7f};       // and its pattern
    expected.resize(expected.size() + sdag::padding);
    EXPECT_EQ(set.payload, expected);
}

TEST(Sdag, MergesAllSymmetriesOfAMap) {
    std::mt19937 random(5);
    const Quadtree map = tests::noise(7, 0.3, random);
    std::vector<Quadtree> maps;
    for (const micromap::VertexOrder& order :
         {micromap::VertexOrder{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}) {
        maps.push_back(micromap::permuted(map.view(), order));
    }
    const EncodedSet all = encodeMaps(maps, Format::fourState);
    const EncodedSet one = encodeMaps({map}, Format::fourState);
    EXPECT_EQ(all.payload.size(), one.payload.size());
    const auto reader = SdagReader::open(viewOf(all));
    ASSERT_TRUE(reader.ok());
    for (uint32_t k = 0; k < maps.size(); ++k) {
        EXPECT_TRUE(micromap::equal(reader->decode(k).view(), maps[k].view())) << k;
    }
}

// Half of a map is another one whole: the half's block of leaves stands once.
TEST(Sdag, SharesLeavesBetweenMapsOfOtherLevels) {
    std::mt19937 random(6);
    const Quadtree small = tests::noise(4, 0.2, random);
    std::vector<uint8_t> flat(micromap::flatBytes(6, Format::fourState));
    std::vector<uint8_t> flatSmall(micromap::flatBytes(4, Format::fourState));
    micromap::writeFlat(small.view(), Format::fourState, flatSmall);
    for (size_t k = 0; k < 16; k += 5) {
        std::copy(flatSmall.begin(), flatSmall.end(),
                  flat.begin() + static_cast<std::ptrdiff_t>(k * flatSmall.size()));
    }
    const Quadtree large = micromap::quadtreeFromFlat(flat, 6, Format::fourState);
    const EncodedSet set = encodeMaps({large, small}, Format::fourState);
    const auto reader = SdagReader::open(viewOf(set));
    ASSERT_TRUE(reader.ok());
    EXPECT_GT(part(*reader, "shared leaves"), 0u);
    EXPECT_EQ(part(*reader, "own leaves"), 0u);
}

TEST(Sdag, IsNeverLargerThanFlat) {
    for (const tests::SampleSet& samples : tests::sampleSets()) {
        for (const Format format : {Format::twoState, Format::fourState}) {
            const auto views = samples.views();
            const auto flat = encodeFlat(views, format, serialExecutor());
            const auto set = encodeSdag(views, format, false, serialExecutor());
            ASSERT_TRUE(flat.ok() && set.ok());
            EXPECT_LE(set->payload.size(), flat->payload.size()) << samples.name;
        }
    }
}

TEST(Sdag, KeepsRandomMapsFlatAmongOthers) {
    std::mt19937 random(7);
    const std::vector<Quadtree> maps{tests::disc(6, 0.6), tests::noise(6, 0, random), tests::disc(6, 0.4)};
    const EncodedSet set = encodeMaps(maps, Format::twoState);
    const auto reader = SdagReader::open(viewOf(set));
    ASSERT_TRUE(reader.ok());
    EXPECT_EQ(part(*reader, "flat maps"), micromap::flatBytes(6, Format::twoState));
    for (uint32_t k = 0; k < 2; ++k) {
        const Quadtree sides = tests::storedMap(Encoding::sdag, Format::twoState, maps[2 * k].view());
        EXPECT_TRUE(micromap::equal(reader->decode(2 * k).view(), sides.view()));
    }
}

// Stored shares are rounded once, counted ones are exact.
TEST(Sdag, SharesAgreeWithCountedOnes) {
    for (const unsigned level : {3u, 6u, 7u, 8u}) {
        const std::vector<Quadtree> maps{tests::disc(level, 0.6)};
        const EncodedSet set = encodeMaps(maps, Format::fourState);
        const EncodedSet withShares = encodeMaps(maps, Format::fourState, true);
        const auto counted = SdagReader::open(viewOf(set));
        const auto stored = SdagReader::open(viewOf(withShares));
        ASSERT_TRUE(counted.ok() && stored.ok());
        for (unsigned coarse = 0; coarse <= level; ++coarse) {
            for (uint32_t k = 0; k < micromap::microTriangleCount(coarse); ++k) {
                const float exact = countedShare(*counted, 0, k, coarse);
                ASSERT_NEAR(counted->opaqueShare(0, k, coarse), exact, 1e-6f) << level << " " << coarse;
                ASSERT_NEAR(stored->opaqueShare(0, k, coarse), exact, 1.0f / 65535) << level << " " << coarse;
            }
        }
    }
}

TEST(Sdag, RefusesAReferenceWithoutALeaf) {
    std::mt19937 random(8);
    const Quadtree map = tests::noise(4, 0.5, random);
    EncodedSet set = encodeMaps({map, tests::disc(4, 0.5)}, Format::fourState);
    sdag::Head head = sdag::readHead(set.descriptors);
    ASSERT_GT(head.shared_bytes, 0u);
    set.descriptors[sdag::Head::bytes] |= 0xf8;  // an address past the leaves, or a symmetry that is none
    EXPECT_FALSE(SdagReader::open(viewOf(set)).ok());
}

}  // namespace
}  // namespace filigree::encoding
