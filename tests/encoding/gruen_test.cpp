#include "filigree/encoding/gruen.h"

#include "filigree/encoding/map_reader.h"

#include "encoding/sample_maps.h"

#include <gtest/gtest.h>

namespace filigree::encoding {
namespace {

using micromap::Format;
using micromap::LatticeTriangle;
using micromap::State;

// Waldemarson and Doggett 2024, figure 2, left: N = 4, row by row from vertex 0.
TEST(Gruen, NumbersRowsFromVertexZero) {
    uint32_t next = 0;
    for (uint32_t row = 0; row < 4; ++row) {
        for (uint32_t k = 0; k < 2 * row + 1; ++k) {
            const bool flipped = k % 2 == 1;
            const uint32_t j = k / 2;
            EXPECT_EQ(rowOrderIndex(LatticeTriangle{row - j - (flipped ? 1 : 0), j, flipped}), next++);
        }
    }
}

// The formula of Gruen, Benthin and Woop, which tinybvh uses too: equal off the lattice's lines.
TEST(Gruen, AgreesWithThePublishedFormula) {
    for (unsigned level = 0; level <= 8; ++level) {
        const int n = 1 << level;
        for (uint32_t k = 0; k < micromap::microTriangleCount(level); ++k) {
            const LatticeTriangle t = micromap::latticeTriangle(k, level);
            const float third = t.flipped ? 2.0f / 3 : 1.0f / 3;
            const float u = (static_cast<float>(t.i) + third) / static_cast<float>(n);
            const float v = (static_cast<float>(t.j) + third) / static_cast<float>(n);
            const int row = static_cast<int>((u + v) * static_cast<float>(n));
            const int diagonal = static_cast<int>((1 - u) * static_cast<float>(n));
            const int published =
                row * row + static_cast<int>(v * static_cast<float>(n)) + (diagonal - (n - 1 - row));
            ASSERT_EQ(rowOrderIndex(u, v, level), static_cast<uint32_t>(published)) << level << " " << k;
        }
    }
}

TEST(Gruen, TurnsCurveIndicesIntoRowOrder) {
    for (unsigned level = 0; level <= 8; ++level) {
        for (uint32_t k = 0; k < micromap::microTriangleCount(level); ++k) {
            ASSERT_EQ(rowOrderOfCurve(k), rowOrderIndex(micromap::latticeTriangle(k, level))) << level;
        }
    }
    for (uint32_t k = 0; k < micromap::microTriangleCount(12); k += 997) {
        ASSERT_EQ(rowOrderOfCurve(k), rowOrderIndex(micromap::latticeTriangle(k, 12)));
    }
}

TEST(Gruen, TiesGoWhereTheCurveSendsThem) {
    for (unsigned level = 0; level <= 6; ++level) {
        for (int i = -2; i <= 66; ++i) {
            for (int j = -2; j <= 66; ++j) {
                const float u = static_cast<float>(i) / 64;
                const float v = static_cast<float>(j) / 64;
                const uint32_t index = micromap::barycentricsToIndex(u, v, level);
                ASSERT_EQ(rowOrderIndex(u, v, level), rowOrderIndex(micromap::latticeTriangle(index, level)));
            }
        }
    }
}

TEST(Gruen, MaybeOpaqueIsConservative) {
    for (const tests::SampleSet& set : tests::sampleSets()) {
        const auto encoded =
            encode(Encoding::gruen, set.views(), Format::twoState, {.maybeOpaque = true}, serialExecutor());
        ASSERT_TRUE(encoded.ok()) << encoded.error().message;
        const auto reader = tests::openGood(viewOf(*encoded));
        for (uint32_t map = 0; map < reader->mapCount(); ++map) {
            if (reader->level(map) > 6) continue;
            std::vector<uint32_t> maps, indices;
            std::vector<State> expected;
            forEachLeaf(set.maps[map], [&](uint64_t first, unsigned depth, State state) {
                const uint64_t end = first + micromap::microTriangleCount(reader->level(map) - depth);
                for (uint64_t k = first; k < end; ++k) {
                    maps.push_back(map);
                    indices.push_back(static_cast<uint32_t>(k));
                    expected.push_back(state == State::transparent ? state : State::unknownOpaque);
                    ASSERT_EQ(reader->at(map, indices.back()), expected.back());
                }
            });
            std::vector<State> states(maps.size());
            reader->lookup(maps, indices, states);
            ASSERT_EQ(states, expected);
        }
    }
}

TEST(Gruen, RefusesAValueThatNoStateHas) {
    const auto map = tests::oddOne(2, 3, State::transparent, State::opaque);
    const auto views = std::array{map.view()};
    auto set = encodeGruen(views, Format::fourState, GruenBit::opaqueSide, serialExecutor());
    ASSERT_TRUE(set.ok());
    set->payload[1] = 0x20;
    const auto reader = GruenReader::open(viewOf(*set));
    ASSERT_FALSE(reader.ok());
    EXPECT_EQ(reader.error().message, "payload: byte 1: value 2 in map 0, expected 0, 1 or 3");
}

}  // namespace
}  // namespace filigree::encoding
