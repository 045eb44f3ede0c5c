#include "filigree/core/target.h"

#include <cstdlib>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace filigree {
namespace {

class TargetTest : public testing::Test {
  protected:
    void TearDown() override {
        ASSERT_TRUE(forceTarget("best").ok());
        ASSERT_TRUE(forceTargetFromEnvironment().ok());
    }
};

TEST_F(TargetTest, ForcesWhatTheProcessorHas) {
    ASSERT_TRUE(forceTarget("scalar").ok());
    EXPECT_EQ(currentTarget(), "EMU128");
    ASSERT_TRUE(forceTarget("best").ok());
    const std::string best = currentTarget();
    for (const char* name : {"sse4", "avx2", "avx3"}) {
        const Status forced = forceTarget(name);
        if (!forced) {
            EXPECT_EQ(forced.error().kind, ErrorKind::unsupported);
            EXPECT_THAT(forced.error().message, testing::HasSubstr(name));
        }
    }
    ASSERT_TRUE(forceTarget("best").ok());
    EXPECT_EQ(currentTarget(), best);
}

TEST_F(TargetTest, UnknownNamesAreUsageErrors) {
    for (const char* name : {"", "avx", "SCALAR", "neon"}) {
        const Status forced = forceTarget(name);
        ASSERT_FALSE(forced.ok()) << name;
        EXPECT_EQ(forced.error().kind, ErrorKind::usage);
    }
}

}  // namespace
}  // namespace filigree
