#include "filigree/bvh/walk.h"

#include "filigree/core/target.h"

#include "bvh/some_boxes.h"

#include <algorithm>
#include <limits>

#include <gmock/gmock.h>

namespace filigree::bvh {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

// Exact but for double rounding, in the box and not outside.
bool meets(const Box& box, const Segment& segment) {
    double entry = segment.tMin;
    double exit = segment.tMax;
    for (size_t k = 0; k < 3; ++k) {
        const double low = double{box.low[k]} - segment.origin[k];
        const double high = double{box.high[k]} - segment.origin[k];
        if (segment.direction[k] == 0) {
            if (low > 0 || high < 0) return false;
            continue;
        }
        entry = std::max(entry, std::min(low / segment.direction[k], high / segment.direction[k]));
        exit = std::min(exit, std::max(low / segment.direction[k], high / segment.direction[k]));
    }
    return entry <= exit;
}

std::vector<uint32_t> leavesMet(const Bvh& bvh, const Segment& segment, WalkOrder order = WalkOrder::near) {
    Walk walk;
    walk.start(segment, largestCoordinates(bvh.nodes[0]));
    std::vector<uint32_t> leaves;
    for (;;) {
        walkFunctions(order).nextLeaf(bvh.nodes.data(), walk);
        if (walk.leaf == noLeaf) return leaves;
        leaves.push_back(bvh.order[walk.leaf]);
    }
}

TEST(BvhWalk, TakesTilesOfATerrainFromNearToFar) {
    std::vector<Box> boxes;
    for (int z = 0; z < 32; ++z)
        for (int x = 0; x < 32; ++x)
            boxes.push_back({{static_cast<float>(x), 0, static_cast<float>(z)},
                             {static_cast<float>(x) + 1, 1, static_cast<float>(z) + 1}});
    const Bvh bvh = build(boxes, serialExecutor());
    for (const float sign : {1.0F, -1.0F}) {
        const Vec3 from{16 - 17 * sign, 0.5F, 16.5F - 17 * sign};
        const auto leaves = leavesMet(bvh, {from, {sign, 0, sign}, 0, infinity});
        ASSERT_GE(leaves.size(), 32U);
        const auto along = [&](uint32_t leaf) { return sign * static_cast<float>(leaf % 32 + leaf / 32); };
        EXPECT_TRUE(std::ranges::is_sorted(leaves, {}, along));
    }
}

// All leaves met are found, and not many others.
void expectFinds(const std::vector<Box>& boxes, const Bvh& bvh, const Segment& segment) {
    std::vector<uint32_t> found = leavesMet(bvh, segment);
    std::sort(found.begin(), found.end());
    ASSERT_EQ(std::adjacent_find(found.begin(), found.end()), found.end());
    std::vector<uint32_t> inAnyOrder = leavesMet(bvh, segment, WalkOrder::any);
    std::sort(inAnyOrder.begin(), inAnyOrder.end());
    ASSERT_EQ(inAnyOrder, found);
    size_t met = 0;
    for (uint32_t k = 0; k < boxes.size(); ++k) {
        if (!meets(boxes[k], segment)) continue;
        ++met;
        ASSERT_TRUE(std::binary_search(found.begin(), found.end(), k)) << "box " << k;
    }
    EXPECT_LE(found.size(), 3 * met + 60);
}

std::vector<Segment> someSegments(float across, unsigned seed) {
    const auto ends = strewnBoxes(200, 2 * across, 0, seed);
    std::vector<Segment> segments;
    for (size_t k = 0; k + 1 < ends.size(); k += 2) {
        Vec3 along = minus(ends[k + 1].low, ends[k].low);
        if (k % 3 == 0) along[k % 2] = 0;
        if (k % 5 == 0) along[2] = -0.0F;
        const float largest = std::max({std::abs(along[0]), std::abs(along[1]), std::abs(along[2])});
        along = times(along, 1 / std::exp2(std::floor(std::log2(largest))));
        const float limit = k % 4 == 0 ? across / 3 : infinity;
        segments.push_back({ends[k].low, along, k % 7 == 0 ? -infinity : 0, limit});
    }
    return segments;
}

TEST(BvhWalk, FindsEveryLeafItMeets) {
    const auto strewn = strewnBoxes(3000, 100, 5);
    const Bvh bvh = build(strewn, serialExecutor());
    for (const Segment& segment : someSegments(100, 2)) expectFinds(strewn, bvh, segment);
    const auto terrain = terrainBoxes(60);
    const Bvh flat = build(terrain, serialExecutor());
    for (const Segment& segment : someSegments(60, 3)) expectFinds(terrain, flat, segment);
}

TEST(BvhWalk, FindsLeavesAlongTheirFaces) {
    std::vector<Box> boxes;
    for (int x = 0; x < 16; ++x) {
        for (int z = 0; z < 16; ++z) {
            const auto east = static_cast<float>(x);
            const auto south = static_cast<float>(z);
            boxes.push_back({{east, 3, south}, {east + 1, 3, south + 1}});
        }
    }
    const Bvh bvh = build(boxes, serialExecutor());
    for (const Vec3& origin : {Vec3{4, 3, -1}, Vec3{4, 3, 5}, Vec3{0, 3, -2}, Vec3{16, 3, 16}}) {
        for (const float sign : {0.0F, -0.0F}) {
            expectFinds(boxes, bvh, {origin, {sign, -sign, 1}, 0, infinity});
            expectFinds(boxes, bvh, {origin, {-1, sign, sign}, 0, infinity});
        }
    }
}

TEST(BvhWalk, FindsLeavesFarFromTheOrigin) {
    for (const float far : {1e3F, 1e6F, 1e12F}) {
        const auto boxes = strewnBoxes(500, 100, 5, 1, {far, -far, far / 3});
        const Bvh bvh = build(boxes, serialExecutor());
        for (size_t k = 0; k < boxes.size(); k += 7) {
            const Vec3 to = boxes[k].low;
            const float largest = std::max({std::abs(to[0]), std::abs(to[1]), std::abs(to[2])});
            const Vec3 along = times(to, 1 / std::exp2(std::floor(std::log2(largest))));
            expectFinds(boxes, bvh, {{0, 0, 0}, along, 0, infinity});
        }
    }
}

TEST(BvhWalk, StopsWhereTheSegmentIsCutShort) {
    const auto boxes = terrainBoxes(60);
    const Bvh bvh = build(boxes, serialExecutor());
    Walk walk;
    walk.start({{-1, 0.2F, 30.5F}, {1, 0, 0}, 0, infinity}, largestCoordinates(bvh.nodes[0]));
    walkFunctions(WalkOrder::near).nextLeaf(bvh.nodes.data(), walk);
    ASSERT_NE(walk.leaf, noLeaf);
    walk.tMax = -1;
    walkFunctions(WalkOrder::near).nextLeaf(bvh.nodes.data(), walk);
    EXPECT_EQ(walk.leaf, noLeaf);
}

TEST(BvhWalk, TakesTheSameWayByTurns) {
    const auto boxes = strewnBoxes(3000, 100, 5);
    const Bvh bvh = build(boxes, serialExecutor());
    const auto segments = someSegments(100, 6);
    std::vector<Walk> walks(segments.size());
    std::vector<Walk*> order;
    for (size_t k = 0; k < walks.size(); ++k) {
        walks[k].start(segments[k], largestCoordinates(bvh.nodes[0]));
        order.push_back(&walks[k]);
    }
    std::vector<std::vector<uint32_t>> ways(walks.size());
    size_t walking = order.size();
    while (walking > 0) {
        const size_t before = walking;
        walking =
            walkFunctions(WalkOrder::near).nextLeaves(bvh.nodes.data(), order.data(), walking, walking / 2);
        for (size_t k = walking; k < before; ++k) {
            if (order[k]->leaf == noLeaf) continue;
            ways[static_cast<size_t>(order[k] - walks.data())].push_back(bvh.order[order[k]->leaf]);
            std::swap(order[k], order[walking++]);
        }
    }
    for (size_t k = 0; k < walks.size(); ++k) EXPECT_EQ(ways[k], leavesMet(bvh, segments[k]));
}

TEST(BvhWalk, TakesTheSameWayWithEveryInstructionSet) {
    const auto boxes = strewnBoxes(3000, 100, 5);
    const Bvh bvh = build(boxes, serialExecutor());
    const auto segments = someSegments(100, 5);
    std::vector<std::vector<uint32_t>> ways;
    for (const Segment& segment : segments) ways.push_back(leavesMet(bvh, segment));
    for (const char* target : {"scalar", "sse4", "avx2", "avx3"}) {
        if (!forceTarget(target)) continue;
        for (size_t k = 0; k < segments.size(); ++k)
            EXPECT_EQ(leavesMet(bvh, segments[k]), ways[k]) << target;
    }
    ASSERT_TRUE(forceTarget("best"));
    ASSERT_TRUE(forceTargetFromEnvironment());
}

}  // namespace
}  // namespace filigree::bvh
