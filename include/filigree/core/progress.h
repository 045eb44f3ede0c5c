// How long work reports where it is, and how a caller stops it.
#pragma once

#include "filigree/core/api.h"

#include <cstdint>
#include <string_view>

namespace filigree {

// Receives progress. Calls may come from several threads at once.
class FILIGREE_API ProgressSink {
  public:
    virtual ~ProgressSink() = default;

    // A new stage begins; `total` counts the units of work in it, named by `unit` ("triangles").
    virtual void begin(std::string_view stage, uint64_t total, std::string_view unit) = 0;

    // `units` more are done.
    virtual void advance(uint64_t units) = 0;

    // The stage is over.
    virtual void end() = 0;

    // True once the caller wants the work to stop; the work then returns ErrorKind::cancelled.
    [[nodiscard]] virtual bool cancelled() const { return false; }
};

// Ignores everything. The reference stays valid for the whole program.
FILIGREE_API ProgressSink& silentProgress();

}  // namespace filigree
