// The threads of a build without oneTBB: each loop starts its own and waits for them.
#include "filigree/core/executor.h"

#include "core/serial_executor.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace filigree {
namespace {

// Set on threads that already run a body: loops inside it stay on their thread.
thread_local bool insideLoop = false;

// Ranges of one loop, handed out to whoever asks next.
class RangeQueue {
  public:
    RangeQueue(size_t count, size_t grain, const std::function<void(size_t, size_t)>& body)
        : count_(count), grain_(grain), body_(body) {}

    // Runs ranges until none is left. The first exception ends the loop and is kept.
    void work() {
        insideLoop = true;
        try {
            for (size_t begin = take(); begin < count_; begin = take())
                body_(begin, begin + std::min(grain_, count_ - begin));
        } catch (...) {
            const std::scoped_lock lock(mutex_);
            if (!thrown_) thrown_ = std::current_exception();
            next_ = ranges();
        }
        insideLoop = false;
    }

    void rethrow() const {
        if (thrown_) std::rethrow_exception(thrown_);
    }

    [[nodiscard]] size_t ranges() const { return (count_ - 1) / grain_ + 1; }

  private:
    // The first index of the next range; `count` or more when there is none.
    size_t take() {
        const size_t range = next_++;
        return range < ranges() ? range * grain_ : count_;
    }

    size_t count_;
    size_t grain_;
    const std::function<void(size_t, size_t)>& body_;
    std::atomic<size_t> next_ = 0;
    std::mutex mutex_;
    std::exception_ptr thrown_;
};

class ThreadExecutor final : public Executor {
  public:
    explicit ThreadExecutor(unsigned threads) : threads_(threads) {}

    void parallelFor(size_t count, size_t grain,
                     const std::function<void(size_t, size_t)>& body) const override {
        if (count == 0) return;
        RangeQueue queue(count, std::max<size_t>(grain, 1), body);
        if (insideLoop || queue.ranges() == 1) return body(0, count);
        std::vector<std::jthread> helpers;
        helpers.reserve(threads_ - 1);
        try {
            for (size_t k = 1; k < std::min<size_t>(threads_, queue.ranges()); ++k)
                helpers.emplace_back([&queue] { queue.work(); });
        } catch (
            const std::system_error&) {  // the machine gives no more threads: those that are there will do
        }
        queue.work();
        helpers.clear();  // waits for them
        queue.rethrow();
    }
    [[nodiscard]] unsigned concurrency() const override { return threads_; }

  private:
    unsigned threads_;
};

}  // namespace

std::unique_ptr<Executor> makeThreadedExecutor(unsigned threads) {
    if (threads == 0) threads = std::max(1U, std::thread::hardware_concurrency());
    if (threads == 1) return std::make_unique<SerialExecutor>();
    return std::make_unique<ThreadExecutor>(threads);
}

}  // namespace filigree
