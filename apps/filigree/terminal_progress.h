// A progress bar on stderr, and the caller's Ctrl-C.
#pragma once

#include "filigree/core/progress.h"

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>

namespace filigree::app {

// Makes Ctrl-C and a termination signal stop the work in an orderly way: every TerminalProgress is then
// cancelled(). A second signal ends the program at once.
void stopOnSignals();

// Draws a bar with the rate and the remaining time where stderr is a terminal and `wanted`; otherwise it is
// silent.
class TerminalProgress final : public ProgressSink {
  public:
    explicit TerminalProgress(bool wanted);

    void begin(std::string_view stage, uint64_t total, std::string_view unit) override;
    void advance(uint64_t units) override;
    void end() override;
    [[nodiscard]] bool cancelled() const override;

  private:
    using Clock = std::chrono::steady_clock;
    void draw(Clock::time_point now);

    const bool drawn_;
    std::mutex mutex_;  // guards everything below but done_
    std::string stage_;
    std::string unit_;
    uint64_t total_ = 0;
    Clock::time_point started_;
    Clock::time_point next_;  // when the bar is drawn again
    bool visible_ = false;
    std::atomic<uint64_t> done_{0};
};

// One line of `columns` characters at most: "bake [####----] 50 %, 1.2M triangles/s, 0:07 left".
std::string progressLine(std::string_view stage, uint64_t done, uint64_t total, std::string_view unit,
                         double seconds, unsigned columns);

}  // namespace filigree::app
