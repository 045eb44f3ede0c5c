#include "filigree/core/stage.h"

#include <algorithm>

#include <fmt/format.h>

namespace filigree {

Stage::Stage(const Executor& executor, ProgressSink& progress, std::string_view name, uint64_t total,
             std::string_view unit)
    : executor_(executor), progress_(progress), name_(name) {
    progress_.begin(name, total, unit);
}

Stage::~Stage() {
    progress_.end();
}

void Stage::parallelFor(size_t count, size_t grain,
                        const std::function<void(size_t begin, size_t end)>& body) const {
    const size_t step = std::max<size_t>(grain, 1);
    executor_.parallelFor(count, step, [&](size_t begin, size_t end) {
        for (size_t at = begin; at < end && !cancelled(); at += step) body(at, std::min(end, at + step));
    });
}

bool Stage::cancelled() const {
    if (!stopped_ && progress_.cancelled()) stopped_ = true;
    return stopped_;
}

Status Stage::status() const {
    if (!stopped_) return {};
    return Error{ErrorKind::cancelled, fmt::format("stopped in the stage \"{}\"", name_)};
}

}  // namespace filigree
