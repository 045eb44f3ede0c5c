// Pruning: never a wrong known state, the least cost there is, and goals that are kept.
#include "filigree/encoding/lossy.h"

#include "filigree/micromap/quadtree_writer.h"

#include "encoding/encoding_name.h"
#include "encoding/lossy_choice.h"
#include "encoding/lossy_tree.h"
#include "encoding/sample_maps.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace filigree::encoding {
namespace {

using micromap::Format;
using micromap::State;

std::vector<State> statesOf(const micromap::QuadtreeView& map) {
    std::vector<State> states;
    forEachLeaf(map, [&](uint64_t, unsigned depth, State state) {
        states.insert(states.end(), micromap::microTriangleCount(map.level - depth), state);
    });
    return states;
}

// Outlines of several sizes, of which some parts are equal, as foliage has them.
micromap::QuadtreeList foliage(Format format) {
    std::mt19937 random(5);
    micromap::QuadtreeList maps;
    for (unsigned k = 0; k < 12; ++k) {
        const auto map = k % 4 == 3 ? tests::noise(4, 0.4, random) : tests::disc(4 + k % 3, 0.25 + 0.05 * k);
        std::vector<uint8_t> flat(micromap::flatBytes(map.view().level, format));
        writeFlat(map.view(), format, flat);
        maps.push(micromap::quadtreeFromFlat(flat, map.view().level, format).view());
    }
    return maps;
}

std::vector<WeightedMap> weighted(const micromap::QuadtreeList& maps) {
    std::vector<WeightedMap> list;
    for (size_t k = 0; k < maps.size(); ++k) list.push_back({maps[k], 0.5 + static_cast<double>(k % 5)});
    return list;
}

class Lossy : public testing::TestWithParam<Encoding> {
  protected:
    static Result<LossySet> run(const std::vector<WeightedMap>& maps, Format format, const LossyGoal& goal,
                                const Executor& executor = serialExecutor()) {
        return encodeLossy(GetParam(), maps, format, {}, goal, executor, silentProgress());
    }
};

// What map `k` became, micro-triangle by micro-triangle.
std::vector<State> afterwards(const LossySet& set, size_t k, uint64_t count) {
    const int32_t index = set.indices[k];
    if (index < 0) return std::vector<State>(count, micromap::stateOfSpecialIndex(index));
    return statesOf(set.maps[static_cast<size_t>(index)]);
}

// The cost, counted anew; fails the test where a known state is wrong.
double recount(const std::vector<WeightedMap>& maps, Format format, const LossySet& set) {
    double cost = 0;
    for (size_t k = 0; k < maps.size(); ++k) {
        const std::vector<State> before = statesOf(maps[k].tree);
        const std::vector<State> after = afterwards(set, k, before.size());
        EXPECT_EQ(before.size(), after.size());
        uint64_t lost = 0;
        for (size_t t = 0; t < before.size(); ++t) {
            const bool lied =
                format == Format::fourState && micromap::isKnown(after[t]) && before[t] != after[t];
            EXPECT_FALSE(lied) << "map " << k << ", micro-triangle " << t;
            lost += format == Format::fourState ? micromap::isKnown(before[t]) && !micromap::isKnown(after[t])
                                                : before[t] != after[t];
        }
        cost += maps[k].weight * static_cast<double>(lost) / static_cast<double>(before.size());
    }
    return cost;
}

TEST_P(Lossy, KeepsTheGoalAndNeverLies) {
    for (const Format format : {Format::twoState, Format::fourState}) {
        const auto list = foliage(format);
        const auto maps = weighted(list);
        for (const double share : {1.0, 0.8, 0.5, 0.2}) {
            const auto lossless = run(maps, format, {.maxBytes = UINT64_MAX, .maxCost = {}});
            ASSERT_TRUE(lossless.ok());
            EXPECT_EQ(lossless->point.cost, 0);
            const auto bytes =
                static_cast<uint64_t>(share * static_cast<double>(lossless->curve.front().bytes));
            const auto set = run(maps, format, {.maxBytes = bytes, .maxCost = {}});
            ASSERT_TRUE(set.ok()) << set.error().message;
            EXPECT_LE(set->point.bytes, bytes);
            EXPECT_EQ(set->point.bytes, set->set.payload.size() + set->set.descriptors.size());
            EXPECT_NEAR(recount(maps, format, *set), set->point.cost, 1e-9);

            const double most = 0.1 * share;
            const auto bounded = run(maps, format, {.maxBytes = {}, .maxCost = most});
            ASSERT_TRUE(bounded.ok());
            EXPECT_LE(bounded->point.cost, most);
            EXPECT_NEAR(recount(maps, format, *bounded), bounded->point.cost, 1e-9);
        }
    }
}

TEST_P(Lossy, TheCurveFalls) {
    const auto list = foliage(Format::fourState);
    const auto set = run(weighted(list), Format::fourState, {.maxBytes = {}, .maxCost = 1.0});
    ASSERT_TRUE(set.ok());
    ASSERT_GE(set->curve.size(), 2u);
    EXPECT_EQ(set->curve.front().cost, 0);
    for (size_t k = 1; k < set->curve.size(); ++k) {
        EXPECT_LT(set->curve[k].bytes, set->curve[k - 1].bytes);
        EXPECT_GE(set->curve[k].cost, set->curve[k - 1].cost);
    }
}

TEST_P(Lossy, WhatItHoldsIsWhatItSays) {
    const auto list = foliage(Format::fourState);
    const auto set = run(weighted(list), Format::fourState, {.maxBytes = {}, .maxCost = 2.0});
    ASSERT_TRUE(set.ok());
    const auto reader = tests::openGood(viewOf(set->set));
    ASSERT_EQ(reader->mapCount(), set->maps.size());
    for (uint32_t map = 0; map < reader->mapCount(); ++map) {
        const auto expected = tests::storedMap(GetParam(), Format::fourState, set->maps[map]);
        EXPECT_TRUE(equal(reader->decode(map).view(), expected.view())) << map;
    }
}

TEST_P(Lossy, ThreadsDoNotChangeABit) {
    const auto list = foliage(Format::fourState);
    const auto maps = weighted(list);
    const auto threads = makeThreadedExecutor(3);
    const LossyGoal goal{.maxBytes = {}, .maxCost = 1.5};
    const auto one = run(maps, Format::fourState, goal);
    const auto many = run(maps, Format::fourState, goal, *threads);
    ASSERT_TRUE(one.ok() && many.ok());
    EXPECT_EQ(one->set.payload, many->set.payload);
    EXPECT_EQ(one->set.descriptors, many->set.descriptors);
    EXPECT_EQ(one->indices, many->indices);
}

TEST_P(Lossy, SetsWithoutMapsAndWithoutWeights) {
    EXPECT_TRUE(run({}, Format::fourState, {.maxBytes = {}, .maxCost = 0.0}).ok());
    const auto list = foliage(Format::fourState);
    auto maps = weighted(list);
    for (WeightedMap& map : maps) map.weight = 0;
    const auto set = run(maps, Format::fourState, {.maxBytes = {}, .maxCost = 0.0});
    ASSERT_TRUE(set.ok());
    EXPECT_EQ(set->maps.size(), 0u);
    EXPECT_EQ(set->point.cost, 0);
}

INSTANTIATE_TEST_SUITE_P(Encodings, Lossy, testing::ValuesIn(tests::testedEncodings), tests::EncodingName{});

TEST(LossyGoals, OutOfReachNamesTheLeast) {
    const auto list = foliage(Format::fourState);
    const auto set = encodeLossy(Encoding::sdag, weighted(list), Format::fourState, {},
                                 {.maxBytes = 1, .maxCost = {}}, serialExecutor(), silentProgress());
    ASSERT_FALSE(set.ok());
    EXPECT_EQ(set.error().kind, ErrorKind::limit);
    EXPECT_NE(set.error().message.find("the least is"), std::string::npos) << set.error().message;
}

// All ways to prune a tree of level 2, by whether each of its five inner nodes becomes a leaf.
double leastByBruteForce(const WeightedMap& map, Format format, const RateModel& model, double price) {
    const std::vector<State> states = statesOf(map.tree);
    double least = std::numeric_limits<double>::infinity();
    for (unsigned choice = 0; choice < 32; ++choice) {
        std::vector<State> pruned = states;
        const auto prune = [&](size_t first, size_t count) {
            size_t opaque = 0;
            for (size_t t = first; t < first + count; ++t)
                opaque += micromap::isOpaqueSide(states[t]) ? 1 : 0;
            const bool side = 2 * opaque >= count;
            const State leaf =
                format == Format::twoState ? micromap::knownOf(side) : micromap::unknownOf(side);
            std::fill_n(pruned.begin() + static_cast<std::ptrdiff_t>(first), count, leaf);
        };
        for (unsigned part = 0; part < 4; ++part) {
            if (((choice >> part) & 1) != 0) prune(4 * part, 4);
        }
        if ((choice & 16) != 0) prune(0, 16);
        std::vector<uint8_t> flat(4, 0);
        size_t lost = 0;
        for (size_t t = 0; t < 16; ++t) {
            flat[t / 4] =
                static_cast<uint8_t>(flat[t / 4] | (static_cast<unsigned>(pruned[t]) << (2 * (t % 4))));
            lost += format == Format::twoState
                        ? pruned[t] != states[t]
                        : micromap::isKnown(states[t]) && !micromap::isKnown(pruned[t]);
        }
        const auto tree = micromap::quadtreeFromFlat(flat, 2, Format::fourState);
        double bits = 0;
        if (!isUniform(tree.view())) {
            size_t leaves = 0;
            forEachLeaf(tree.view(), [&](uint64_t, unsigned, State) { ++leaves; });
            bits = model.mapBits[2] + static_cast<double>(leaves) * model.leafBits +
                   static_cast<double>((leaves - 1) / 3) * model.innerBits[1];
        }
        least = std::min(least, bits + price * map.weight * static_cast<double>(lost) / 16);
    }
    return least;
}

double valueOf(const WeightedMap& map, const micromap::QuadtreeView& pruned, double cost,
               const RateModel& model, double price) {
    size_t leaves = 0;
    forEachLeaf(pruned, [&](uint64_t, unsigned, State) { ++leaves; });
    const double bits = isUniform(pruned)
                            ? 0
                            : model.mapBits[map.tree.level] + static_cast<double>(leaves) * model.leafBits +
                                  static_cast<double>((leaves - 1) / 3) * model.innerBits[1];
    return bits + price * cost;
}

TEST(LossyTree, FindsTheLeastOfAllPrunings) {
    RateModel model;
    model.innerBits.fill(1);
    model.leafBits = 3;
    model.mapBits.fill(20);
    std::mt19937 random(3);
    for (unsigned round = 0; round < 400; ++round) {
        const Format format = round % 2 == 0 ? Format::fourState : Format::twoState;
        const auto made = tests::noise(2, 0.3, random);
        const auto tree =
            format == Format::twoState ? micromap::coarsened(made.view(), 2, Format::twoState) : made;
        std::vector<uint8_t> flat(micromap::flatBytes(2, format));
        writeFlat(tree.view(), format, flat);
        const auto plain = micromap::quadtreeFromFlat(flat, 2, format);
        if (isUniform(plain.view())) continue;
        const WeightedMap map{plain.view(), 1.0 + round % 3};
        for (const double price : {0.0, 1.0, 8.0, 20.0, 50.0, 300.0}) {
            const auto pruned = makeTreePruner({&map, 1}, format, model)->prune(price, serialExecutor());
            EXPECT_NEAR(valueOf(map, pruned.maps[0].view(), pruned.cost, model, price),
                        leastByBruteForce(map, format, model, price), 1e-9)
                << "round " << round << ", price " << price;
        }
    }
}

}  // namespace
}  // namespace filigree::encoding
