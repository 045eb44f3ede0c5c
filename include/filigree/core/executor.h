// Where parallel work runs. Algorithms take an Executor and never start a thread themselves.
#pragma once

#include "filigree/core/api.h"

#include <cstddef>
#include <functional>
#include <memory>

namespace filigree {

// Runs loops. Implementations may call the body from several threads at once, each index exactly once, in any
// order; algorithms must give the same bytes whatever the order.
class FILIGREE_API Executor {
  public:
    virtual ~Executor() = default;

    // Calls body(begin, end) on ranges that together cover [0, count). A range holds at most `grain` indices
    // where the work is split; `grain` 0 counts as 1. Nested calls are allowed.
    virtual void parallelFor(size_t count, size_t grain,
                             const std::function<void(size_t begin, size_t end)>& body) const = 0;

    // How many threads may run bodies at once, at least 1.
    [[nodiscard]] virtual unsigned concurrency() const = 0;
};

// Runs everything on the calling thread. The reference stays valid for the whole program.
FILIGREE_API const Executor& serialExecutor();

// A pool of `threads` threads (0: one for each processor) on oneTBB; without oneTBB (FILIGREE_TBB=OFF) each
// loop starts its threads, and loops inside a loop stay on one.
FILIGREE_API std::unique_ptr<Executor> makeThreadedExecutor(unsigned threads);

}  // namespace filigree
