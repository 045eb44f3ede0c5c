// How long work reports where it is, and how a caller stops it.
#pragma once

#include "filigree/core/api.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
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

    // True once the caller wants the work to stop, and from then on; the work then returns
    // ErrorKind::cancelled.
    [[nodiscard]] virtual bool cancelled() const { return false; }
};

// Ignores everything. The reference stays valid for the whole program.
FILIGREE_API ProgressSink& silentProgress();

// Where work is.
struct ProgressReport {
    std::string_view stage;  // valid during the call
    std::string_view unit;   // of `done` and `total`
    uint64_t done = 0;
    uint64_t total = 0;
};

// Progress as a function, and cancelling as a flag, both the caller's and both optional. The function is
// called at the begin and the end of each stage and whenever another hundredth of it is done; by one thread
// at a time, though not always the same. It must not throw; it may call cancel().
class FILIGREE_API FunctionProgress final : public ProgressSink {
  public:
    using Function = std::function<void(const ProgressReport& report)>;

    // `cancelFlag` must outlive this; work stops soon after it becomes true.
    explicit FunctionProgress(Function function, const std::atomic<bool>* cancelFlag = nullptr);

    // The flag alone.
    explicit FunctionProgress(const std::atomic<bool>& cancelFlag);

    void begin(std::string_view stage, uint64_t total, std::string_view unit) override;
    void advance(uint64_t units) override;
    void end() override;
    [[nodiscard]] bool cancelled() const override;

    // As the flag.
    void cancel() { stopped_ = true; }

  private:
    void report();

    const Function function_;
    const std::atomic<bool>* const flag_;
    mutable std::atomic<bool> stopped_{false};  // for good
    std::mutex mutex_;                          // guards the rest but done_
    std::string stage_;
    std::string unit_;
    uint64_t total_ = 0;
    uint64_t next_ = 0;  // when it is time to report again
    std::atomic<uint64_t> done_{0};
};

}  // namespace filigree
