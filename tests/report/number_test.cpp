#include "filigree/report/number.h"

#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

namespace filigree::report {
namespace {

TEST(Number, countsAreGroupedByThousands) {
    EXPECT_EQ(formatCount(0), "0");
    EXPECT_EQ(formatCount(999), "999");
    EXPECT_EQ(formatCount(1000), "1,000");
    EXPECT_EQ(formatCount(123456), "123,456");
    EXPECT_EQ(formatCount(UINT64_MAX), "18,446,744,073,709,551,615");
}

TEST(Number, decimalsKeepTheirPlaces) {
    EXPECT_EQ(formatNumber(12345.678, 2), "12,345.68");
    EXPECT_EQ(formatNumber(-1234.5, 1), "-1,234.5");
    EXPECT_EQ(formatNumber(-123, 0), "-123");
    EXPECT_EQ(formatNumber(NAN, 2), "-");
}

TEST(Number, compactNumbersAreShort) {
    EXPECT_EQ(formatCompact(0), "0");
    EXPECT_EQ(formatCompact(0.25), "0.25");
    EXPECT_EQ(formatCompact(0.000001), "0.000001");
    EXPECT_EQ(formatCompact(1024), "1,024");
    EXPECT_EQ(formatCompact(12500), "12.5k");
    EXPECT_EQ(formatCompact(3e6), "3M");
    EXPECT_EQ(formatCompact(999999), "1M");
    EXPECT_EQ(formatCompact(-2e9), "-2G");
    EXPECT_EQ(formatCompact(5e15), "5,000T");
    EXPECT_EQ(formatCompact(INFINITY), "-");
}

TEST(Number, bytesUseBinaryUnits) {
    EXPECT_EQ(formatBytes(0), "0 B");
    EXPECT_EQ(formatBytes(1023), "1023 B");
    EXPECT_EQ(formatBytes(1024), "1.00 KiB");
    EXPECT_EQ(formatBytes(1536.0 * 1024), "1.50 MiB");
    EXPECT_EQ(formatBytes(std::pow(2.0, 55)), "32,768 TiB");
}

TEST(Number, sharesNeverRoundToAllOrNothing) {
    EXPECT_EQ(formatShare(0), "0.00 %");
    EXPECT_EQ(formatShare(1), "100.00 %");
    EXPECT_EQ(formatShare(0.97314), "97.31 %");
    EXPECT_EQ(formatShare(1e-9), "< 0.01 %");
    EXPECT_EQ(formatShare(1 - 1e-9), "> 99.99 %");
}

}  // namespace
}  // namespace filigree::report
