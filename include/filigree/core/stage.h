// A stage of long work: shown, run on an executor, and stopped where the caller cancels.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace filigree {

// Begins a stage of a sink, and ends it when it goes out of scope. Its loops run on another executor, range
// by range, and leave out all ranges that are left once the caller has cancelled; then and from then on
// status() is an error, and what the loops were to make is incomplete.
class FILIGREE_API Stage final : public Executor {
  public:
    // Both must outlive this.
    Stage(const Executor& executor, ProgressSink& progress, std::string_view name, uint64_t total,
          std::string_view unit);
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;
    ~Stage() override;

    void parallelFor(size_t count, size_t grain,
                     const std::function<void(size_t begin, size_t end)>& body) const override;
    [[nodiscard]] unsigned concurrency() const override { return executor_.concurrency(); }

    void advance(uint64_t units) const { progress_.advance(units); }

    // Asks the sink; true for good once it was.
    [[nodiscard]] bool cancelled() const;

    // ErrorKind::cancelled where something was left out or cancelled() was true.
    [[nodiscard]] Status status() const;

  private:
    const Executor& executor_;
    ProgressSink& progress_;
    const std::string_view name_;
    mutable std::atomic<bool> stopped_{false};
};

}  // namespace filigree
