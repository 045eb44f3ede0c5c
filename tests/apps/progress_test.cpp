#include "terminal_progress.h"

#include <gtest/gtest.h>

namespace filigree::app {
namespace {

TEST(ProgressLine, ShowsBarRateAndRemainingTime) {
    EXPECT_EQ(progressLine("bake", 50, 200, "triangles", 5, 80),
              "bake [#######-----------------------]  25 %, 10 triangles/s, 0:15 left");
}

TEST(ProgressLine, KnowsNoRemainingTimeAtTheStart) {
    EXPECT_EQ(progressLine("bake", 0, 200, "triangles", 0, 80),
              "bake [------------------------------]   0 %, 0 triangles/s");
}

TEST(ProgressLine, StaysWithinTheTerminal) {
    for (unsigned columns = 0; columns < 120; ++columns) {
        EXPECT_LE(progressLine("examine", 7, 9, "micro-triangles", 12345, columns).size(), columns);
    }
}

TEST(ProgressLine, TakesAnyNumbers) {
    EXPECT_EQ(progressLine("bake", 5, 0, "units", 1, 80).find("nan"), std::string::npos);
    EXPECT_NE(progressLine("bake", 900, 100, "units", 1, 80).find("100 %"), std::string::npos);
    EXPECT_NE(progressLine("bake", 1, uint64_t{1} << 60, "units", 1e6, 80).find(" left"), std::string::npos);
}

}  // namespace
}  // namespace filigree::app
