#include "filigree/core/executor.h"

#include <atomic>
#include <vector>

#include <gtest/gtest.h>

namespace filigree {
namespace {

void expectEachOnce(const Executor& executor, size_t count, size_t grain) {
    std::vector<std::atomic<int>> visits(count);
    executor.parallelFor(count, grain, [&](size_t begin, size_t end) {
        for (size_t k = begin; k < end; ++k) ++visits[k];
    });
    for (const auto& v : visits) ASSERT_EQ(v, 1);
}

TEST(Executor, VisitsEachIndexOnce) {
    for (const unsigned threads : {0U, 1U, 2U, 4U}) {
        const auto executor = makeThreadedExecutor(threads);
        for (const size_t count : {0U, 1U, 7U, 1000U}) {
            for (const size_t grain : {0U, 1U, 16U, 5000U}) expectEachOnce(*executor, count, grain);
        }
    }
    expectEachOnce(serialExecutor(), 100, 3);
}

TEST(Executor, RangesAreNoLargerThanTheGrain) {
    const auto executor = makeThreadedExecutor(3);
    executor->parallelFor(1000, 16, [](size_t begin, size_t end) { EXPECT_LE(end - begin, 16U); });
}

TEST(Executor, CallsMayNest) {
    const auto executor = makeThreadedExecutor(4);
    std::atomic<size_t> sum = 0;
    executor->parallelFor(20, 1, [&](size_t begin, size_t end) {
        for (size_t k = begin; k < end; ++k) {
            executor->parallelFor(50, 4, [&](size_t first, size_t last) { sum += last - first; });
        }
    });
    EXPECT_EQ(sum, 1000U);
}

TEST(Executor, TellsHowManyThreadsMayRun) {
    EXPECT_EQ(serialExecutor().concurrency(), 1U);
    EXPECT_EQ(makeThreadedExecutor(1)->concurrency(), 1U);
    EXPECT_EQ(makeThreadedExecutor(3)->concurrency(), 3U);
    EXPECT_GE(makeThreadedExecutor(0)->concurrency(), 1U);
}

}  // namespace
}  // namespace filigree
