#include "filigree/core/stage.h"

#include <numeric>

#include <gtest/gtest.h>

namespace filigree {
namespace {

TEST(Stage, RunsEachIndexOnceInRangesOfTheGrain) {
    FunctionProgress progress([](const ProgressReport&) {});
    const Stage stage(serialExecutor(), progress, "encode", 100, "micromaps");
    std::vector<int> runs(100);
    stage.parallelFor(100, 16, [&](size_t begin, size_t end) {
        EXPECT_LE(end - begin, 16U);
        for (size_t k = begin; k < end; ++k) ++runs[k];
    });
    EXPECT_EQ(runs, std::vector<int>(100, 1));
    EXPECT_TRUE(stage.status());
}

TEST(Stage, LeavesOutWhatIsLeftForGood) {
    std::atomic<bool> stop = false;
    FunctionProgress progress(stop);
    const Stage stage(serialExecutor(), progress, "encode", 100, "micromaps");
    size_t done = 0;
    const auto body = [&](size_t begin, size_t end) {
        done += end - begin;
        if (done == 30) stop = true;
    };
    stage.parallelFor(100, 10, body);
    EXPECT_EQ(done, 30U);
    stop = false;
    stage.parallelFor(100, 10, body);
    EXPECT_EQ(done, 30U);
    ASSERT_FALSE(stage.status());
    EXPECT_EQ(stage.status().error().kind, ErrorKind::cancelled);
    EXPECT_EQ(stage.status().error().message, "stopped in the stage \"encode\"");
}

TEST(Stage, IsWholeWhereTheCallerCancelsTooLate) {
    std::atomic<bool> stop = false;
    FunctionProgress progress(stop);
    const Stage stage(serialExecutor(), progress, "encode", 1, "micromaps");
    stage.parallelFor(1, 1, [&](size_t, size_t) { stop = true; });
    EXPECT_TRUE(stage.status());
    EXPECT_TRUE(stage.cancelled());
    EXPECT_FALSE(stage.status());
}

TEST(Stage, BeginsAndEnds) {
    std::vector<uint64_t> reports;
    FunctionProgress progress([&](const ProgressReport& report) { reports.push_back(report.done); });
    {
        const Stage stage(serialExecutor(), progress, "encode", 2, "micromaps");
        stage.advance(2);
    }
    EXPECT_EQ(reports, (std::vector<uint64_t>{0, 2, 2}));
}

}  // namespace
}  // namespace filigree
