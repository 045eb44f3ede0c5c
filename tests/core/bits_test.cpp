#include "filigree/core/bits.h"

#include "filigree/core/bytes.h"

#include <array>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace filigree {
namespace {

struct Field {
    uint64_t bits;
    unsigned count;
};

std::vector<Field> randomFields(uint32_t seed, size_t count) {
    std::mt19937_64 random(seed);
    std::vector<Field> fields;
    for (size_t k = 0; k < count; ++k) fields.push_back({random(), static_cast<unsigned>(random() % 65)});
    return fields;
}

uint64_t low(uint64_t bits, unsigned count) {
    return count == 64 ? bits : bits & ((uint64_t{1} << count) - 1);
}

TEST(Bits, WhatIsWrittenIsRead) {
    const auto fields = randomFields(1, 5000);
    BitWriter writer;
    for (const Field& f : fields) writer.append(f.bits, f.count);
    BitReader reader(writer.words(), writer.size());
    size_t position = 0;
    for (const Field& f : fields) {
        EXPECT_EQ(reader.position(), position);
        EXPECT_EQ(reader.take(f.count), low(f.bits, f.count));
        position += f.count;
    }
    EXPECT_EQ(reader.left(), 0U);
}

TEST(Bits, LeastSignificantComesFirst) {
    BitWriter writer;
    writer.append(1, 1);
    writer.append(0, 2);
    writer.append(0xff, 4);
    EXPECT_EQ(writer.words()[0], 0x79U);
    EXPECT_EQ(writer.size(), 7U);
}

TEST(Bits, AppendingAnotherIsAppendingItsBits) {
    for (const size_t head : {0U, 1U, 63U, 64U, 65U}) {
        for (const size_t tail : {0U, 1U, 63U, 64U, 65U, 1000U}) {
            BitWriter whole;
            BitWriter first;
            BitWriter second;
            std::mt19937_64 random(static_cast<unsigned>(head * 1000 + tail));
            for (size_t k = 0; k < head + tail; ++k) {
                const uint64_t bit = random() & 1;
                whole.append(bit, 1);
                (k < head ? first : second).append(bit, 1);
            }
            first.append(second);
            ASSERT_EQ(first.size(), whole.size());
            EXPECT_EQ(std::move(first).take(), std::move(whole).take());
        }
    }
}

TEST(Bits, TruncatingTakesBackAndLeavesNoRest) {
    for (size_t size = 0; size <= 130; ++size) {
        BitWriter writer;
        for (int k = 0; k < 3; ++k) writer.append(~uint64_t{0}, 64);
        writer.truncate(size);
        EXPECT_EQ(writer.size(), size);
        EXPECT_EQ(writer.words().size(), (size + 63) / 64);
        writer.append(0, 5);
        writer.append(1, 1);
        BitReader reader(writer.words(), writer.size());
        for (size_t k = 0; k < size; ++k) EXPECT_TRUE(reader.takeBit());
        EXPECT_EQ(reader.take(6), 32U);
    }
}

TEST(Bytes, AreLittleEndianAtAnyAddress) {
    std::array<uint8_t, 12> bytes{};
    storeLe<uint32_t>(&bytes[1], 0x12345678);
    EXPECT_EQ(bytes[1], 0x78);
    EXPECT_EQ(bytes[4], 0x12);
    EXPECT_EQ(loadLe<uint32_t>(&bytes[1]), 0x12345678U);
    storeLe<uint64_t>(&bytes[3], 0xfedcba9876543210U);
    EXPECT_EQ(loadLe<uint64_t>(&bytes[3]), 0xfedcba9876543210U);
    EXPECT_EQ(loadLe<uint16_t>(&bytes[3]), 0x3210U);
    EXPECT_EQ(loadLe<uint8_t>(&bytes[10]), 0xfeU);
}

}  // namespace
}  // namespace filigree
