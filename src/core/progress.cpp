#include "filigree/core/progress.h"

#include <algorithm>
#include <utility>

namespace filigree {
namespace {

class SilentProgress final : public ProgressSink {
  public:
    void begin(std::string_view, uint64_t, std::string_view) override {}
    void advance(uint64_t) override {}
    void end() override {}
};

}  // namespace

ProgressSink& silentProgress() {
    static SilentProgress sink;
    return sink;
}

FunctionProgress::FunctionProgress(Function function, const std::atomic<bool>* cancelFlag)
    : function_(std::move(function)), flag_(cancelFlag) {}

FunctionProgress::FunctionProgress(const std::atomic<bool>& cancelFlag) : flag_(&cancelFlag) {}

void FunctionProgress::begin(std::string_view stage, uint64_t total, std::string_view unit) {
    const std::lock_guard lock(mutex_);
    stage_ = stage;
    unit_ = unit;
    total_ = total;
    done_ = 0;
    report();
}

void FunctionProgress::advance(uint64_t units) {
    done_ += units;
    if (!function_) return;
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (lock && done_ >= next_) report();
}

void FunctionProgress::end() {
    const std::lock_guard lock(mutex_);
    report();
}

bool FunctionProgress::cancelled() const {
    if (flag_ != nullptr && *flag_) stopped_ = true;
    return stopped_;
}

void FunctionProgress::report() {
    const uint64_t done = done_;
    next_ = done + std::max<uint64_t>(total_ / 100, 1);
    if (function_) function_({stage_, unit_, done, total_});
}

}  // namespace filigree
