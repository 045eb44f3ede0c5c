// The border of the C API: no exception passes, every outcome is a code and a line of text.
#pragma once

#include "capi/failure.h"

namespace filigree::capi {

// False for one that cannot be written to.
bool isUsable(const filigree_error_info* info);

filigree_error reportSuccess(filigree_error_info* info);

// Of the exception that is being handled.
filigree_error reportFailure(filigree_error_info* info);

// Runs the work of a function.
template <class Work>
filigree_error call(filigree_error_info* info, Work&& work) noexcept {
    if (!isUsable(info)) return FILIGREE_ERROR_STRUCT;
    try {
        work();
    } catch (...) {
        return reportFailure(info);
    }
    return reportSuccess(info);
}

// The same for a function that makes a handle: *out is what `work` returns, or NULL.
template <class Handle, class Work>
filigree_error make(Handle** out, filigree_error_info* info, Work&& work) noexcept {
    if (out != nullptr) *out = nullptr;
    return call(info, [&] {
        if (out == nullptr) fail(FILIGREE_ERROR_ARGUMENT, "out: is NULL");
        *out = work();
    });
}

}  // namespace filigree::capi
