// What goes in comes out, for every encoding.
#include "filigree/core/target.h"
#include "filigree/micromap/curve.h"

#include "encoding/encoding_name.h"
#include "encoding/sample_maps.h"

#include <cmath>
#include <memory>

#include <gtest/gtest.h>

namespace filigree::encoding {
namespace {

using micromap::Format;
using micromap::State;
using tests::SampleSet;

class RoundTrip : public testing::TestWithParam<Encoding> {
  protected:
    // check(set, format, encoded, reader) for all sample sets.
    template <class Check>
    void forAllSets(Check check) {
        static const std::vector<SampleSet> sets = tests::sampleSets();
        for (const SampleSet& set : sets) {
            for (const Format format : {Format::twoState, Format::fourState}) {
                SCOPED_TRACE(set.name + (format == Format::twoState ? ", 2-state" : ", 4-state"));
                const EncodedSet encoded = tests::encodeGood(GetParam(), set, format);
                const auto reader = tests::openGood(viewOf(encoded));
                check(set, format, encoded, *reader);
                if (HasFailure()) return;
            }
        }
    }
};

// Points of a batch, in maps at random.
struct Points {
    std::vector<uint32_t> maps, indices;
    std::vector<float> u, v;
    Points(const MapReader& reader, size_t count, unsigned seed) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> unit(-0.1F, 1.1F);
        for (size_t k = 0; k < count; ++k) {
            maps.push_back(random() % reader.mapCount());
            const uint64_t triangles = micromap::microTriangleCount(reader.level(maps.back()));
            indices.push_back(static_cast<uint32_t>(random() % triangles));
            const float a = unit(random);
            const float b = unit(random) * (1 - a);
            // Some on the lattice's lines, where ties are decided.
            const bool tie = k % 4 == 0;
            u.push_back(tie ? std::round(a * 8) / 8 : a);
            v.push_back(tie ? std::round(b * 8) / 8 : b);
        }
    }
};

TEST_P(RoundTrip, GivesBackEveryMap) {
    forAllSets([&](const SampleSet& set, Format format, const EncodedSet& encoded, const MapReader& reader) {
        EXPECT_EQ(encoded.encoding, GetParam());
        EXPECT_EQ(encoded.format, format);
        EXPECT_EQ(encoded.mapCount, set.maps.size());
        ASSERT_EQ(reader.mapCount(), set.maps.size());
        for (uint32_t map = 0; map < reader.mapCount(); ++map) {
            ASSERT_EQ(reader.level(map), set.maps[map].level) << "map " << map;
            const auto expected = tests::storedMap(GetParam(), format, set.maps[map]);
            ASSERT_TRUE(equal(reader.decode(map).view(), expected.view())) << "map " << map;
        }
    });
}

TEST_P(RoundTrip, FindsEveryState) {
    forAllSets([&](const SampleSet& set, Format format, const EncodedSet&, const MapReader& reader) {
        for (uint32_t map = 0; map < reader.mapCount(); ++map) {
            // Some thousand leaves of the large ones.
            const uint64_t step = 1 + set.maps[map].bits / 3'000;
            uint64_t leaf = 0;
            forEachLeaf(set.maps[map], [&](uint64_t first, unsigned depth, State state) {
                if (leaf++ % step != 0) return;
                const uint64_t count = micromap::microTriangleCount(set.maps[map].level - depth);
                const State expected = tests::storedState(GetParam(), format, state);
                for (const uint64_t index : {first, first + count / 3, first + count - 1}) {
                    ASSERT_EQ(reader.at(map, static_cast<uint32_t>(index)), expected)
                        << "map " << map << ", micro-triangle " << index;
                }
            });
            if (HasFailure()) return;
        }
    });
}

TEST_P(RoundTrip, FindsPointsAsTheCurveDoes) {
    forAllSets([&](const SampleSet&, Format, const EncodedSet&, const MapReader& reader) {
        if (reader.mapCount() == 0) return;
        const Points points(reader, 1000, 1);
        for (size_t k = 0; k < points.maps.size(); ++k) {
            const uint32_t map = points.maps[k];
            const uint32_t index = micromap::barycentricsToIndex(points.u[k], points.v[k], reader.level(map));
            ASSERT_EQ(reader.at(map, points.u[k], points.v[k]), reader.at(map, index)) << "point " << k;
        }
    });
}

void compareBatches(const MapReader& reader, const Points& points) {
    const size_t count = points.maps.size();
    std::vector<State> byIndex(count);
    std::vector<State> byPoint(count);
    reader.lookup(points.maps, points.indices, byIndex);
    reader.lookup(points.maps, points.u, points.v, byPoint);
    for (size_t k = 0; k < count; ++k) {
        ASSERT_EQ(byIndex[k], reader.at(points.maps[k], points.indices[k])) << "point " << k;
        ASSERT_EQ(byPoint[k], reader.at(points.maps[k], points.u[k], points.v[k])) << "point " << k;
    }
}

TEST_P(RoundTrip, BatchesFindTheSameOnEveryTarget) {
    for (const char* target : {"scalar", "sse4", "avx2", "avx3"}) {
        SCOPED_TRACE(target);
        if (!forceTarget(target)) continue;
        forAllSets([&](const SampleSet&, Format, const EncodedSet&, const MapReader& reader) {
            compareBatches(reader, Points(reader, 0, 0));
            if (reader.mapCount() == 0) return;
            for (const size_t count : {1u, 2u, 7u, 17u, 300u}) {
                compareBatches(reader, Points(reader, count, static_cast<unsigned>(count)));
            }
        });
    }
    ASSERT_TRUE(forceTarget("best"));
    ASSERT_TRUE(forceTargetFromEnvironment());
}

TEST_P(RoundTrip, ThreadsDoNotChangeABit) {
    const auto two = makeThreadedExecutor(2);
    const auto three = makeThreadedExecutor(3);
    forAllSets([&](const SampleSet& set, Format format, const EncodedSet& encoded, const MapReader&) {
        for (const Executor* executor : {two.get(), three.get()}) {
            const EncodedSet again = tests::encodeGood(GetParam(), set, format, *executor);
            EXPECT_EQ(again.descriptors, encoded.descriptors);
            EXPECT_EQ(again.payload, encoded.payload);
        }
    });
}

TEST_P(RoundTrip, PartsAddUp) {
    forAllSets([&](const SampleSet&, Format, const EncodedSet& encoded, const MapReader& reader) {
        uint64_t bits = 0;
        for (const Part& part : reader.parts()) bits += part.bits;
        EXPECT_EQ(bits, 8 * (encoded.descriptors.size() + encoded.payload.size()));
    });
}

INSTANTIATE_TEST_SUITE_P(Encodings, RoundTrip, testing::ValuesIn(tests::testedEncodings),
                         tests::EncodingName{});

}  // namespace
}  // namespace filigree::encoding
