#include "filigree/bvh/build.h"

#include "bvh/some_boxes.h"

#include <bit>
#include <cstring>
#include <limits>

#include <gmock/gmock.h>

namespace filigree::bvh {
namespace {

bool contains(const Box& outer, const Box& inner) {
    for (size_t k = 0; k < 3; ++k) {
        if (!(outer.low[k] <= inner.low[k] && inner.high[k] <= outer.high[k])) return false;
    }
    return true;
}

// Every child's box holds all given boxes under it.
void expectContains(const Bvh& bvh, std::span<const Box> boxes) {
    std::vector<Box> exact(bvh.nodes.size());
    for (size_t at = bvh.nodes.size(); at-- > 0;) {
        const Node& node = bvh.nodes[at];
        uint32_t child = node.firstChild;
        uint32_t leaf = node.firstLeaf;
        for (size_t k = 0; k < width; ++k) {
            Box inner;
            if ((node.innerMask >> k & 1) != 0) inner = exact[child++];
            if ((node.leafMask >> k & 1) != 0) inner = boxes[bvh.order[leaf++]];
            if (inner.empty()) continue;
            ASSERT_TRUE(contains(node.childBox(k), inner)) << "node " << at << " child " << k;
            exact[at].extend(inner);
        }
    }
}

void expectGood(std::span<const Box> boxes) {
    const Bvh bvh = build(boxes, serialExecutor());
    ASSERT_EQ(bvh.order.size(), boxes.size());
    const Status status = check(bvh.nodes, boxes.size());
    ASSERT_TRUE(status) << status.error().message;
    std::vector<uint8_t> isSeen(boxes.size());
    for (const uint32_t index : bvh.order) {
        ASSERT_LT(index, boxes.size());
        EXPECT_EQ(isSeen[index]++, 0);
    }
    expectContains(bvh, boxes);
}

double slotsFilled(const Bvh& bvh) {
    size_t filled = 0;
    for (const Node& node : bvh.nodes) {
        filled += static_cast<size_t>(std::popcount(static_cast<unsigned>(node.innerMask | node.leafMask)));
    }
    return static_cast<double>(filled) / static_cast<double>(width * bvh.nodes.size());
}

TEST(BvhBuild, HoldsAllBoxesOfAnyNumber) {
    for (const size_t count : {1, 2, 3, 7, 8, 9, 15, 16, 17, 64, 65, 500, 1023, 1024, 1025, 5000}) {
        SCOPED_TRACE(count);
        expectGood(strewnBoxes(count, 100, 5));
    }
    expectGood(terrainBoxes(150));
}

TEST(BvhBuild, TakesBoxesThatCannotBeToldApart) {
    expectGood(std::vector<Box>(3000, Box{{1, 2, 3}, {4, 5, 6}}));
    expectGood(std::vector<Box>(3000, Box{{1, 2, 3}, {1, 2, 3}}));
}

TEST(BvhBuild, TakesPlacesOfAllSizes) {
    expectGood(strewnBoxes(3000, 1e30F, 1e28F));
    expectGood(strewnBoxes(3000, 1e-30F, 1e-32F));
    expectGood(strewnBoxes(3000, 1, 0.1F, 1, {1e6F, -1e7F, 1e8F}));
    constexpr float most = std::numeric_limits<float>::max() / 4;
    expectGood(std::vector<Box>{{{-most, -most, -most}, {most, most, most}}, {{0, 0, 0}, {1, 1, most}}});
    constexpr float least = std::numeric_limits<float>::denorm_min();
    expectGood(std::vector<Box>{{{-least, 0, 0}, {0, least, least}}, {{0, 0, 0}, {least, 1, 0}}});
}

TEST(BvhBuild, StaysShallowWhereEachBoxDwarfsTheLast) {
    std::vector<Box> boxes;
    for (int k = 0; k < 3840; ++k) {
        const float side = std::ldexp(1.0F + static_cast<float>(k % 16) / 16, k / 16 - 120);
        boxes.push_back({{0, 0, 0}, {side, side, side}});
        boxes.push_back({{side, side, side}, {side, side, side}});
    }
    expectGood(boxes);
}

TEST(BvhBuild, FillsNodes) {
    EXPECT_GT(slotsFilled(build(terrainBoxes(128), serialExecutor())), 0.95);
    EXPECT_GT(slotsFilled(build(terrainBoxes(131), serialExecutor())), 0.94);
    EXPECT_GT(slotsFilled(build(strewnBoxes(20000, 100, 5), serialExecutor())), 0.70);
}

TEST(BvhBuild, GivesTheSameNodesForAnyExecutor) {
    const auto threads = makeThreadedExecutor(4);
    for (const auto& boxes : {strewnBoxes(200000, 100, 5), terrainBoxes(70)}) {
        const Bvh alone = build(boxes, serialExecutor());
        const Bvh together = build(boxes, *threads);
        EXPECT_EQ(alone.order, together.order);
        ASSERT_EQ(alone.nodes.size(), together.nodes.size());
        EXPECT_EQ(std::memcmp(alone.nodes.data(), together.nodes.data(), alone.nodes.size() * sizeof(Node)),
                  0);
    }
}

TEST(BvhBuild, StopsAndRefuses) {
    const auto boxes = strewnBoxes(5000, 100, 5);
    uint64_t done = 0;
    FunctionProgress shown([&](const ProgressReport& report) { done = report.done; });
    const Result<Bvh> whole = build(boxes, serialExecutor(), shown);
    ASSERT_TRUE(whole);
    EXPECT_EQ(whole->order, build(boxes, serialExecutor()).order);
    EXPECT_EQ(done, boxes.size());

    const std::atomic<bool> stop = true;
    FunctionProgress stopped(stop);
    EXPECT_EQ(build(boxes, serialExecutor(), stopped).error().kind, ErrorKind::cancelled);

    const float infinite = std::numeric_limits<float>::infinity();
    for (const std::vector<Box>& wrong :
         {std::vector<Box>{}, std::vector<Box>{Box{}}, std::vector<Box>{{{0, 0, 0}, {1, infinite, 1}}}}) {
        const Result<Bvh> built = build(wrong, serialExecutor(), silentProgress());
        ASSERT_FALSE(built);
        EXPECT_EQ(built.error().kind, ErrorKind::usage);
    }
}

}  // namespace
}  // namespace filigree::bvh
