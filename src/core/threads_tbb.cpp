#include "filigree/core/executor.h"

#include "core/serial_executor.h"

#include <tbb/blocked_range.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace filigree {
namespace {

class TbbExecutor final : public Executor {
  public:
    explicit TbbExecutor(unsigned threads) : arena_(static_cast<int>(threads)) {}

    void parallelFor(size_t count, size_t grain,
                     const std::function<void(size_t, size_t)>& body) const override {
        arena_.execute([&] {
            tbb::parallel_for(
                tbb::blocked_range<size_t>(0, count, grain > 0 ? grain : 1),
                [&](const tbb::blocked_range<size_t>& range) { body(range.begin(), range.end()); },
                tbb::simple_partitioner());
        });
    }
    [[nodiscard]] unsigned concurrency() const override {
        return static_cast<unsigned>(arena_.max_concurrency());
    }

  private:
    mutable tbb::task_arena arena_;
};

}  // namespace

std::unique_ptr<Executor> makeThreadedExecutor(unsigned threads) {
    if (threads == 0) threads = static_cast<unsigned>(tbb::info::default_concurrency());
    if (threads == 1) return std::make_unique<SerialExecutor>();
    return std::make_unique<TbbExecutor>(threads);
}

}  // namespace filigree
