// Loops on the caller's threads.
#pragma once

#include "filigree/core/executor.h"

#include "filigree.h"

namespace filigree::capi {

class CallerExecutor final : public Executor {
  public:
    CallerExecutor(filigree_parallel_for callback, void* user, unsigned concurrency)
        : callback_(callback), user_(user), concurrency_(concurrency) {}

    // What a body throws is thrown again here, past the caller's code. Throws a Failure where the callback
    // left indices out or made some up.
    void parallelFor(size_t count, size_t grain,
                     const std::function<void(size_t begin, size_t end)>& body) const override;
    [[nodiscard]] unsigned concurrency() const override { return concurrency_; }

  private:
    filigree_parallel_for callback_;
    void* user_;
    unsigned concurrency_;
};

}  // namespace filigree::capi
