#include "filigree/micromap/buffers.h"

#include "micromap/random_micromap.h"

#include <gtest/gtest.h>

namespace filigree::micromap {
namespace {

TreeSet someSet(Format format = Format::fourState) {
    std::mt19937 random(3);
    TreeSet set;
    set.format = format;
    set.indices = {0, -1, 2, 1, -4};
    for (const unsigned level : {0u, 3u, 1u}) {
        const auto flat = tests::randomFlat(level, 0.1, random);
        set.trees.push(quadtreeFromFlat(flat, level, Format::fourState).view());
    }
    return set;
}

// Buffers of the sizes of a set, each with some bytes more that must stay as they are.
struct Owned {
    explicit Owned(const BufferSizes& sizes)
        : data(sizes.dataBytes + 3, 0xcd),
          records(sizes.recordBytes + 3, 0xcd),
          indices(sizes.indexBytes + 3, 0xcd) {}
    [[nodiscard]] Buffers buffers() { return {data, records, indices}; }

    std::vector<uint8_t> data;
    std::vector<uint8_t> records;
    std::vector<uint8_t> indices;
};

void expectFills(const TreeSet& set, IndexType type, size_t width) {
    const auto sizes = sizesOf(set, type);
    ASSERT_TRUE(sizes);
    EXPECT_EQ(static_cast<size_t>(sizes->indexType), width);
    Owned owned(*sizes);
    ASSERT_TRUE(fill(set, owned.buffers(), type));

    auto flat = flatten(set);
    ASSERT_TRUE(flat);
    ensureOneRecord(*flat, set.format);
    flat->data.insert(flat->data.end(), 3, 0xcd);
    EXPECT_EQ(owned.data, flat->data);
    std::vector<uint8_t> records(recordBytes * flat->records.size());
    writeRecords(flat->records, records);
    records.insert(records.end(), 3, 0xcd);
    EXPECT_EQ(owned.records, records);
    std::vector<uint8_t> indices(width * set.indices.size());
    writeIndices(set.indices, width, indices);
    indices.insert(indices.end(), 3, 0xcd);
    EXPECT_EQ(owned.indices, indices);
}

TEST(Buffers, HoldWhatFlattenMakes) {
    expectFills(someSet(), IndexType::smallest, 1);
    expectFills(someSet(Format::twoState), IndexType::uint16, 2);
    expectFills(someSet(), IndexType::uint32, 4);
}

TEST(Buffers, HoldOneRecordWhereAllIsSpecial) {
    TreeSet set;
    set.indices = {-1, -2};
    expectFills(set, IndexType::smallest, 1);
    expectFills({}, IndexType::smallest, 1);
}

TEST(Buffers, RecordsAndSpecialIndicesAreThoseOfTheApis) {
    TreeSet set = someSet();
    const auto sizes = sizesOf(set, IndexType::uint16);
    Owned owned(*sizes);
    ASSERT_TRUE(fill(set, owned.buffers(), IndexType::uint16));
    const std::vector<uint8_t> second(owned.records.begin() + 8, owned.records.begin() + 16);
    EXPECT_EQ(second, (std::vector<uint8_t>{1, 0, 0, 0, 3, 0, 2, 0}));
    EXPECT_EQ(std::vector<uint8_t>(owned.indices.begin(), owned.indices.begin() + 10),
              (std::vector<uint8_t>{0, 0, 0xff, 0xff, 2, 0, 1, 0, 0xfc, 0xff}));
}

TEST(Buffers, RefuseWhatIsTooSmall) {
    const TreeSet set = someSet();
    for (const int which : {0, 1, 2}) {
        Owned owned(*sizesOf(set));
        Buffers to = owned.buffers();
        std::span<uint8_t>& one = which == 0 ? to.data : which == 1 ? to.records : to.indices;
        one = one.first(one.size() - 4);
        const Status status = fill(set, to);
        ASSERT_FALSE(status);
        EXPECT_EQ(status.error().kind, ErrorKind::usage);
        EXPECT_EQ(owned.data, std::vector<uint8_t>(owned.data.size(), 0xcd));
    }
    EXPECT_FALSE(fill(set, {}));
}

TEST(Buffers, RefuseOverlaps) {
    const TreeSet set = someSet();
    const BufferSizes sizes = *sizesOf(set);
    std::vector<uint8_t> memory(1000);
    const std::span<uint8_t> all = memory;
    const auto apart = fill(set, {all, all.subspan(sizes.dataBytes), all.subspan(500)});
    EXPECT_TRUE(apart) << apart.error().message;
    for (const auto& to : {Buffers{all, all.subspan(sizes.dataBytes - 1), all.subspan(500)},
                           Buffers{all.subspan(100), all, all.subspan(100)},
                           Buffers{all, all.subspan(500), all.subspan(500 + sizes.recordBytes - 1)}}) {
        const Status status = fill(set, to);
        ASSERT_FALSE(status);
        EXPECT_EQ(status.error().kind, ErrorKind::usage);
    }
}

TEST(Buffers, RefuseAnIndexTypeThatIsTooSmall) {
    TreeSet set;
    const auto tree = quadtreeFromFlat(std::vector<uint8_t>{0x1b}, 1, Format::fourState);
    for (int k = 0; k < 300; ++k) {
        set.trees.push(tree.view());
        set.indices.push_back(k);
    }
    EXPECT_EQ(sizesOf(set)->indexType, IndexType::uint16);
    const auto sizes = sizesOf(set, IndexType::uint8);
    ASSERT_FALSE(sizes);
    EXPECT_EQ(sizes.error().message, "indices of 1 byte, but 300 records need 2");
}

TEST(Buffers, StopWhenCancelled) {
    const TreeSet set = someSet();
    Owned owned(*sizesOf(set));
    const std::atomic<bool> stop = true;
    FunctionProgress progress(stop);
    const Status status = fill(set, owned.buffers(), IndexType::smallest, serialExecutor(), progress);
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().kind, ErrorKind::cancelled);
    EXPECT_EQ(flatten(set, serialExecutor(), progress).error().kind, ErrorKind::cancelled);
}

TEST(Buffers, UsageByTrianglesCountsTriangles) {
    const std::vector<Record> records{{0, 3, Format::fourState}, {16, 2, Format::fourState}};
    const std::vector<int32_t> indices{0, 0, -1, 1, 7, 0};
    const auto usage = usageByTriangles(indices, records);
    ASSERT_EQ(usage.size(), 2u);
    EXPECT_EQ(usage[0].level, 2u);
    EXPECT_EQ(usage[0].count, 1u);
    EXPECT_EQ(usage[1].count, 3u);
}

}  // namespace
}  // namespace filigree::micromap
