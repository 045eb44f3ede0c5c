#include "filigree/micromap/set.h"

#include "micromap/random_micromap.h"

#include <gtest/gtest.h>

namespace filigree::micromap {
namespace {

TEST(Set, FlattenLaysRecordsEndToEnd) {
    std::mt19937 random(3);
    for (const Format format : {Format::twoState, Format::fourState}) {
        TreeSet set;
        set.format = format;
        set.indices = {0, -1, 2, 1, -4};
        for (const unsigned level : {0u, 3u, 1u}) {
            const auto flat = tests::randomFlat(level, 0.1, random);
            set.trees.push(quadtreeFromFlat(flat, level, Format::fourState).view());
        }
        const Result<FlatSet> flat = flatten(set);
        ASSERT_TRUE(flat);
        EXPECT_EQ(flat->data.size(), flatDataBytes(set));
        EXPECT_EQ(flat->indices, set.indices);
        ASSERT_EQ(flat->records.size(), 3u);
        EXPECT_EQ(flat->records[1].byteOffset, 1u);
        for (size_t k = 0; k < 3; ++k) {
            forEachLeaf(set.trees[k], [&](uint64_t first, unsigned, State state) {
                const State expected = format == Format::fourState ? state : knownOf(isOpaqueSide(state));
                EXPECT_EQ(flatState(*flat, flat->records[k], first), expected);
            });
        }
    }
}

TEST(Set, UsageCountsAddUp) {
    const std::vector<Record> records{
        {0, 3, Format::fourState}, {16, 2, Format::fourState}, {20, 3, Format::fourState}};
    const std::vector<UsageCount> usage = usageCounts(records);
    ASSERT_EQ(usage.size(), 2u);
    EXPECT_EQ(usage[0].level, 2u);
    EXPECT_EQ(usage[0].count, 1u);
    EXPECT_EQ(usage[1].level, 3u);
    EXPECT_EQ(usage[1].count, 2u);
}

}  // namespace
}  // namespace filigree::micromap
