// Pairs of states: what is kept, what is given up, and what readers refuse.
#include "filigree/encoding/one_bit.h"

#include "encoding/sample_maps.h"

#include <gtest/gtest.h>

namespace filigree::encoding {
namespace {

using micromap::Format;
using micromap::State;
using tests::SampleSet;

State stateAt(const micromap::QuadtreeView& map, uint64_t index) {
    State found = State::transparent;
    forEachLeaf(map, [&](uint64_t first, unsigned depth, State state) {
        if (index - first < micromap::microTriangleCount(map.level - depth)) found = state;
    });
    return found;
}

// Every leaf of `map` is kept or unknown in `reduced`, on no other side where it was known.
void expectConservative(const micromap::QuadtreeView& map, const micromap::QuadtreeView& reduced) {
    forEachLeaf(reduced, [&](uint64_t first, unsigned depth, State state) {
        if (!micromap::isKnown(state)) return;
        const uint64_t count = micromap::microTriangleCount(map.level - depth);
        for (const uint64_t index : {first, first + count / 2, first + count - 1})
            ASSERT_EQ(stateAt(map, index), state) << "micro-triangle " << index;
    });
}

std::vector<SampleSet> smallSets() {
    std::vector<SampleSet> sets = tests::sampleSets();
    std::erase_if(sets, [](const SampleSet& set) { return set.name == "deep" || set.name == "mixed"; });
    return sets;
}

TEST(OneBit, NeverMakesUpAKnownState) {
    for (const SampleSet& set : smallSets()) {
        SCOPED_TRACE(set.name);
        for (size_t k = 0; k < set.maps.size(); k += 2) {
            if (set.maps[k].level > 5) continue;
            expectConservative(set.maps[k], inPair(set.maps[k], bestPair(set.maps[k])).view());
            if (HasFailure()) return;
        }
    }
}

TEST(OneBit, SidesAndPairGiveAllBack) {
    for (const SampleSet& set : smallSets()) {
        for (size_t k = 0; k < set.maps.size(); ++k) {
            const StatePair pair = bestPair(set.maps[k]);
            const auto reduced = inPair(set.maps[k], pair);
            const auto sides = fromPair(reduced.view(), StatePair::transparentOpaque);
            ASSERT_TRUE(equal(fromPair(sides.view(), pair).view(), reduced.view())) << set.name << " " << k;
            const uint64_t kept = countStates(reduced.view()).known();
            const micromap::StateCounts counts = countStates(set.maps[k]);
            const bool known = counts.known() == counts.total();
            ASSERT_EQ(kept, known ? counts.known() : std::max(counts.of[0], counts.of[1])) << set.name;
        }
    }
}

TEST(OneBit, TiesGoByTheSideOfTheGreaterPart) {
    EXPECT_EQ(bestPair(tests::checkerboard(3, State::unknownOpaque, State::unknownTransparent).view()),
              StatePair::transparentUnknown);
    EXPECT_EQ(bestPair(tests::oddOne(3, 5, State::unknownTransparent, State::unknownOpaque).view()),
              StatePair::unknownOpaque);
    EXPECT_EQ(bestPair(tests::checkerboard(3, State::transparent, State::opaque).view()),
              StatePair::transparentOpaque);
    EXPECT_EQ(bestPair(tests::oddOne(3, 5, State::opaque, State::unknownTransparent).view()),
              StatePair::unknownOpaque);
}

TEST(OneBit, EveryEncodingHoldsThem) {
    const SampleSet set = tests::smallSet();
    SampleSet reduced{"reduced", {}};
    std::vector<StatePair> pairs;
    for (size_t k = 0; k < set.maps.size(); ++k) {
        pairs.push_back(bestPair(set.maps[k]));
        reduced.maps.push(inPair(set.maps[k], pairs.back()).view());
    }
    const std::vector<uint8_t> packed = packPairs(pairs);
    for (const Encoding encoding : tests::testedEncodings) {
        const EncodedSet encoded = tests::encodeGood(encoding, reduced, Format::twoState);
        const auto reader = tests::openGood(viewOf(encoded));
        const auto unpacked = PairReader::open(viewOf(encoded), packed);
        ASSERT_TRUE(unpacked.ok()) << unpacked.error().message;
        for (uint32_t map = 0; map < reader->mapCount(); ++map) {
            const auto back = fromPair(reader->decode(map).view(), (*unpacked)[map]);
            EXPECT_TRUE(equal(back.view(), reduced.maps[map])) << nameOf(encoding) << ", map " << map;
        }
    }
}

std::string whyRefused(const EncodedView& set, std::vector<uint8_t> bytes) {
    const auto reader = PairReader::open(set, bytes);
    return reader.ok() ? "" : reader.error().message;
}

TEST(OneBit, PairsAreCheckedInFull) {
    EncodedView set;
    set.format = Format::twoState;
    set.mapCount = 5;
    for (unsigned low = 0; low < 256; ++low) {
        bool good = true;
        for (unsigned map = 0; map < 4; ++map) good = good && ((low >> (2 * map)) & 3) != 3;
        EXPECT_EQ(whyRefused(set, {static_cast<uint8_t>(low), 2}).empty(), good) << low;
        EXPECT_EQ(whyRefused(set, {0, static_cast<uint8_t>(low)}).empty(), low < 3) << low;
    }
    EXPECT_EQ(whyRefused(set, {0xC0, 0}), "pairs: map 3 has code 3, which is reserved");
    EXPECT_EQ(whyRefused(set, {0, 0x10}), "pairs: spare bits of the last byte are not zero");
    for (const size_t size : {0u, 1u, 3u}) {
        EXPECT_EQ(whyRefused(set, std::vector<uint8_t>(size)),
                  "pairs: " + std::to_string(size) + " bytes for 5 maps, 2 expected");
    }
    set.format = Format::fourState;
    EXPECT_EQ(whyRefused(set, {0, 0}), "pairs: only 2-state micromaps have some");
}

}  // namespace
}  // namespace filigree::encoding
