#include "filigree/core/progress.h"

#include "filigree/core/executor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace filigree {
namespace {

TEST(FunctionProgress, ReportsBeginEndAndHundredths) {
    std::vector<uint64_t> done;
    FunctionProgress progress([&](const ProgressReport& report) {
        EXPECT_EQ(report.stage, "bake");
        EXPECT_EQ(report.unit, "triangles");
        EXPECT_EQ(report.total, 1000U);
        done.push_back(report.done);
    });
    progress.begin("bake", 1000, "triangles");
    for (int k = 0; k < 1000; ++k) progress.advance(1);
    progress.end();
    EXPECT_EQ(done.size(), 102U);
    EXPECT_EQ(done.front(), 0U);
    EXPECT_EQ(done.back(), 1000U);
    EXPECT_TRUE(std::ranges::is_sorted(done));
    EXPECT_FALSE(progress.cancelled());
}

TEST(FunctionProgress, CallsFromOneThreadAtATime) {
    const auto executor = makeThreadedExecutor(4);
    int calls = 0;  // not atomic: the lock must do
    uint64_t last = 0;
    FunctionProgress progress([&](const ProgressReport& report) {
        ++calls;
        last = report.done;
    });
    progress.begin("bake", 10'000, "triangles");
    executor->parallelFor(10'000, 10, [&](size_t begin, size_t end) { progress.advance(end - begin); });
    progress.end();
    EXPECT_GE(calls, 2);
    EXPECT_EQ(last, 10'000U);
}

TEST(FunctionProgress, StopsByFlagOrByCall) {
    std::atomic<bool> stop = false;
    const FunctionProgress flagged(stop);
    EXPECT_FALSE(flagged.cancelled());
    stop = true;
    EXPECT_TRUE(flagged.cancelled());
    stop = false;
    EXPECT_TRUE(flagged.cancelled());

    FunctionProgress* self = nullptr;
    FunctionProgress progress([&](const ProgressReport& report) {
        if (report.done > 5) self->cancel();
    });
    self = &progress;
    progress.begin("bake", 10, "triangles");
    EXPECT_FALSE(progress.cancelled());
    progress.advance(6);
    EXPECT_TRUE(progress.cancelled());
}

}  // namespace
}  // namespace filigree
