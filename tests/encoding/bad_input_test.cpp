// Bytes from outside: an error, or lookups that stay inside. Blocks are copied to memory of exactly their
// size, so that a sanitizer sees the first byte read past an end.
#include "filigree/core/target.h"

#include "encoding/encoding_name.h"
#include "encoding/sample_maps.h"
#include "exact_bytes.h"

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

namespace filigree::encoding {
namespace {

using micromap::Format;
using micromap::State;
using Bytes = std::vector<uint8_t>;

// Looks everywhere a set claims to reach, within bounds of time.
void useAll(const MapReader& reader) {
    std::vector<uint32_t> maps;
    std::vector<uint32_t> indices;
    for (uint32_t map = 0; map < std::min(reader.mapCount(), 32u); ++map) {
        const uint64_t count = micromap::microTriangleCount(reader.level(map));
        if (reader.level(map) <= 6) {
            ASSERT_EQ(reader.decode(map).view().level, reader.level(map));
        }
        for (uint64_t k = 0; k < 48; ++k) {
            maps.push_back(map);
            indices.push_back(static_cast<uint32_t>(k * (count - 1) / 47));
            ASSERT_LE(static_cast<unsigned>(reader.at(map, indices.back())), 3u);
        }
    }
    std::vector<State> states(maps.size());
    reader.lookup(maps, indices, states);
    for (size_t k = 0; k < maps.size(); ++k) ASSERT_EQ(states[k], reader.at(maps[k], indices[k]));
    uint64_t bits = 0;
    for (const Part& part : reader.parts()) bits += part.bits;
    ASSERT_EQ(bits % 8, 0u);
}

class BadInput : public testing::TestWithParam<std::tuple<Encoding, Format>> {
  protected:
    // The scalar target, since sanitizers do not see the gathers of the others.
    void SetUp() override { ASSERT_TRUE(forceTarget("scalar")); }
    void TearDown() override {
        ASSERT_TRUE(forceTarget("best"));
        ASSERT_TRUE(forceTargetFromEnvironment());
    }

    [[nodiscard]] static EncodedSet small() {
        return tests::encodeGood(std::get<0>(GetParam()), tests::smallSet(), std::get<1>(GetParam()));
    }

    // Opens copies of the blocks and uses what can be opened; true when they were refused.
    [[nodiscard]] static bool refused(EncodedView set) {
        const tests::ExactBytes descriptors(set.descriptors);
        const tests::ExactBytes payload(set.payload);
        set.descriptors = descriptors.view();
        set.payload = payload.view();
        const auto reader = openReader(set);
        if (reader) useAll(**reader);
        if (!reader) {
            EXPECT_FALSE(reader.error().message.empty());
        }
        return !reader;
    }
};

TEST_P(BadInput, ExactCopiesAreGood) {
    const EncodedSet good = small();
    EXPECT_FALSE(refused(viewOf(good)));
}

TEST_P(BadInput, EveryPrefixIsRefused) {
    const EncodedSet good = small();
    for (size_t size = 0; size < good.descriptors.size(); ++size) {
        EncodedView cut = viewOf(good);
        cut.descriptors = cut.descriptors.first(size);
        EXPECT_TRUE(refused(cut)) << size << " bytes of descriptors";
    }
    for (size_t size = 0; size < good.payload.size(); ++size) {
        EncodedView cut = viewOf(good);
        cut.payload = cut.payload.first(size);
        EXPECT_TRUE(refused(cut)) << size << " bytes of payload";
    }
}

TEST_P(BadInput, SurplusBytesAreRefused) {
    for (const uint8_t surplus : {0, 1, 255}) {
        EncodedSet more = small();
        more.descriptors.push_back(surplus);
        EXPECT_TRUE(refused(viewOf(more)));
        more = small();
        more.payload.push_back(surplus);
        EXPECT_TRUE(refused(viewOf(more)));
    }
}

TEST_P(BadInput, FlippedBitsStayInside) {
    EncodedSet set = small();
    for (Bytes* block : {&set.descriptors, &set.payload}) {
        const size_t step = 1 + 8 * block->size() / 1000;
        for (size_t bit = 0; bit < 8 * block->size(); bit += step) {
            const auto mask = static_cast<uint8_t>(1u << (bit % 8));
            (*block)[bit / 8] ^= mask;
            static_cast<void>(refused(viewOf(set)));
            (*block)[bit / 8] ^= mask;
            ASSERT_FALSE(HasFailure()) << "bit " << bit;
        }
    }
}

TEST_P(BadInput, RandomBytesStayInside) {
    std::mt19937 random(3);
    const EncodedSet good = small();
    for (unsigned round = 0; round < 600; ++round) {
        EncodedSet set = good;
        Bytes& block = random() % 2 == 0 && !set.descriptors.empty() ? set.descriptors : set.payload;
        const size_t first = random() % block.size();
        const size_t count = std::min<size_t>(1 + random() % 8, block.size() - first);
        const bool ones = random() % 4 == 0;
        for (size_t k = first; k < first + count; ++k) {
            block[k] = static_cast<uint8_t>(ones ? 255 : random());
        }
        static_cast<void>(refused(viewOf(set)));
        ASSERT_FALSE(HasFailure()) << "round " << round;
    }
}

TEST_P(BadInput, WrongCountsAreRefused) {
    const EncodedSet good = small();
    constexpr uint32_t most = std::numeric_limits<uint32_t>::max();
    for (const uint32_t count : {0u, 1u, good.mapCount - 1, good.mapCount + 1, 1u << 16, 1u << 29, 1u << 30,
                                 1u << 31, (1u << 31) + good.mapCount, most}) {
        EncodedView set = viewOf(good);
        set.mapCount = count;
        EXPECT_TRUE(refused(set)) << count << " maps";
    }
}

TEST_P(BadInput, BlocksOfOnesAreRefused) {
    EncodedSet set = small();
    std::ranges::fill(set.descriptors, uint8_t{255});
    EXPECT_TRUE(refused(viewOf(set)));
}

INSTANTIATE_TEST_SUITE_P(Encodings, BadInput,
                         testing::Combine(testing::ValuesIn(tests::testedEncodings),
                                          testing::Values(Format::twoState, Format::fourState)),
                         tests::EncodingName{});

}  // namespace
}  // namespace filigree::encoding
