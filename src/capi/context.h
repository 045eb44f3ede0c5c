// The context of a call: threads and memory.
#pragma once

#include "filigree/core/executor.h"

#include "capi/memory.h"
#include "filigree.h"

#include <memory>

struct filigree_context {
    filigree::capi::Memory memory;
    std::unique_ptr<filigree::Executor> executor;  // null: the calling thread
};

namespace filigree::capi {

inline Memory memoryOf(const filigree_context* context) {
    return context == nullptr ? Memory() : context->memory;
}
inline const Executor& executorOf(const filigree_context* context) {
    return context == nullptr || context->executor == nullptr ? serialExecutor() : *context->executor;
}

}  // namespace filigree::capi
