// The caller's progress callback as a sink.
#pragma once

#include "filigree/core/progress.h"

#include "capi/sized.h"

#include <algorithm>
#include <array>

namespace filigree::capi {

class CallerProgress {
  public:
    explicit CallerProgress(const filigree_progress* given)
        : progress_(taken(given, FILIGREE_PROGRESS_INIT, "progress")),
          sink_([this](const ProgressReport& report) { tell(report); }) {}
    CallerProgress(const CallerProgress&) = delete;
    CallerProgress& operator=(const CallerProgress&) = delete;

    ProgressSink& sink() { return sink_; }

  private:
    void tell(const ProgressReport& report) {
        if (progress_.callback == nullptr) return;
        // May be called where nothing may be thrown: no allocation.
        std::array<char, 64> stage{};
        std::copy_n(report.stage.begin(), std::min(report.stage.size(), stage.size() - 1), stage.begin());
        if (progress_.callback(progress_.user, stage.data(), report.done, report.total) != 0) sink_.cancel();
    }

    filigree_progress progress_;
    FunctionProgress sink_;
};

}  // namespace filigree::capi
