#include "capi/caller_executor.h"

#include "capi/failure.h"

#include <atomic>
#include <exception>

namespace filigree::capi {
namespace {

// One loop, as the caller's code hands it around.
class Loop {
  public:
    Loop(size_t count, const std::function<void(size_t, size_t)>& body) : count_(count), body_(body) {}

    static void run(void* loop, size_t begin, size_t end) { static_cast<Loop*>(loop)->run(begin, end); }

    void finish() {
        if (thrown_) std::rethrow_exception(thrown_);
        if (strayed_ || done_ != count_)
            fail(FILIGREE_ERROR_ARGUMENT, "parallel_for: its ranges do not cover [0, {}) once", count_);
    }

  private:
    void run(size_t begin, size_t end) noexcept {
        if (begin >= end || end > count_) {
            if (begin != end) strayed_ = true;
            return;
        }
        done_ += end - begin;
        try {
            if (!stopped_) body_(begin, end);
        } catch (...) {
            if (!stopped_.exchange(true)) thrown_ = std::current_exception();
        }
    }

    const size_t count_;
    const std::function<void(size_t, size_t)>& body_;
    std::atomic<size_t> done_{0};
    std::atomic<bool> strayed_{false};
    std::atomic<bool> stopped_{false};
    std::exception_ptr thrown_;
};

}  // namespace

void CallerExecutor::parallelFor(size_t count, size_t grain,
                                 const std::function<void(size_t, size_t)>& body) const {
    if (count == 0) return;
    Loop loop(count, body);
    callback_(user_, count, grain > 0 ? grain : 1, Loop::run, &loop);
    loop.finish();
}

}  // namespace filigree::capi
