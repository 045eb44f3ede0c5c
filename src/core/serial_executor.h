// Everything on the calling thread.
#pragma once

#include "filigree/core/executor.h"

namespace filigree {

class SerialExecutor final : public Executor {
  public:
    void parallelFor(size_t count, size_t /*grain*/,
                     const std::function<void(size_t, size_t)>& body) const override {
        if (count > 0) body(0, count);
    }
    [[nodiscard]] unsigned concurrency() const override { return 1; }
};

}  // namespace filigree
