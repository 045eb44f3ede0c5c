#include "filigree/bvh/build.h"

#include "bvh/some_boxes.h"

#include <limits>

#include <gmock/gmock.h>

namespace filigree::bvh {
namespace {

using testing::HasSubstr;

class BvhCheck : public testing::Test {
  protected:
    void expectBad(const std::string& what) const {
        const Status status = check(bvh_.nodes, 300);
        ASSERT_FALSE(status);
        EXPECT_THAT(status.error().message, HasSubstr(what));
    }
    // A node with children.
    Node& parent() { return bvh_.nodes[0]; }

    Bvh bvh_ = build(strewnBoxes(300, 100, 5), serialExecutor());
};

TEST_F(BvhCheck, TakesWhatWasBuilt) {
    EXPECT_TRUE(check(bvh_.nodes, 300));
}

TEST_F(BvhCheck, WantsARoot) {
    EXPECT_FALSE(check({}, 0));
}

TEST_F(BvhCheck, WantsAllLeaves) {
    EXPECT_FALSE(check(bvh_.nodes, 299));
    EXPECT_FALSE(check(bvh_.nodes, 301));
    EXPECT_FALSE(check(bvh_.nodes, std::numeric_limits<uint64_t>::max()));
}

TEST_F(BvhCheck, WantsChildrenBehindTheirParents) {
    parent().firstChild = 0;
    expectBad("node 0: children 0 to");
}

TEST_F(BvhCheck, WantsChildrenThatExist) {
    parent().firstChild = std::numeric_limits<uint32_t>::max();
    expectBad("node 0: children 4294967295 to");
}

TEST_F(BvhCheck, WantsOneParent) {
    ASSERT_NE(bvh_.nodes[1].innerMask, 0);
    --bvh_.nodes[1].firstChild;
    expectBad("has two parents");
}

TEST_F(BvhCheck, WantsEveryNodeReached) {
    bvh_.nodes.emplace_back();
    expectBad("no node above it");
}

TEST_F(BvhCheck, WantsEachLeafOnce) {
    Node& last = bvh_.nodes.back();
    ASSERT_GT(last.firstLeaf, 0U);
    --last.firstLeaf;
    expectBad("stands in two nodes");
}

TEST_F(BvhCheck, WantsLeavesThatExist) {
    bvh_.nodes.back().firstLeaf = 299;
    expectBad("leaves 299 to");
}

TEST_F(BvhCheck, WantsKindsThatExist) {
    parent().leafMask = 1;
    expectBad("both a node and a leaf");
}

TEST_F(BvhCheck, WantsSlotsOnThreeAxes) {
    parent().slotAxes = 3 << 2;
    expectBad("node 0: slots along axis 3");
    parent().slotAxes = 64;
    expectBad("bits behind the axes");
    parent().slotAxes = 0;
    parent().zeros[5] = 1;
    expectBad("bits behind the axes");
}

TEST_F(BvhCheck, WantsALatticeThatFloatsHold) {
    parent().exponent[2] = -127;
    expectBad("exponent -127");
    parent().exponent[2] = 0;
    parent().origin[1] = std::numeric_limits<float>::quiet_NaN();
    expectBad("not finite");
}

TEST_F(BvhCheck, WantsWaysOfBoundedLength) {
    std::vector<Node> chain(maxDepth + 1);
    for (size_t k = 0; k < maxDepth; ++k) {
        chain[k].innerMask = 1;
        chain[k].firstChild = static_cast<uint32_t>(k + 1);
    }
    EXPECT_FALSE(check(chain, 0));
    chain.pop_back();
    chain.back().innerMask = 0;
    EXPECT_TRUE(check(chain, 0));
}

}  // namespace
}  // namespace filigree::bvh
