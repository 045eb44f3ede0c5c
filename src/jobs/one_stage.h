// Several pieces of work shown as one stage.
#pragma once

#include "filigree/core/progress.h"

#include <atomic>

namespace filigree::jobs {

// Begins a stage of the given sink, ends it when it goes out of scope, and passes on the advances of all work
// in between, whose own stages do not show. Their units must add up to `total`.
class OneStage final : public ProgressSink {
  public:
    OneStage(ProgressSink& sink, std::string_view stage, uint64_t total, std::string_view unit)
        : sink_(sink) {
        sink_.begin(stage, total, unit);
    }
    OneStage(const OneStage&) = delete;
    OneStage& operator=(const OneStage&) = delete;
    ~OneStage() override { sink_.end(); }

    void begin(std::string_view, uint64_t, std::string_view) override {}
    void advance(uint64_t units) override {
        done_ += units;
        sink_.advance(units);
    }
    void end() override {}
    [[nodiscard]] bool cancelled() const override { return sink_.cancelled(); }

    // Advances to `units` since the beginning, where work took fewer steps than it has units.
    void advanceTo(uint64_t units) {
        if (const uint64_t done = done_; units > done) advance(units - done);
    }

  private:
    ProgressSink& sink_;
    std::atomic<uint64_t> done_{0};
};

}  // namespace filigree::jobs
