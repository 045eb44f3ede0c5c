// How the functions behind the C API fail: by an exception that no caller ever sees (capi/call.h).
#pragma once

#include "filigree/core/result.h"

#include "filigree.h"

#include <string>
#include <utility>

#include <fmt/format.h>

namespace filigree::capi {

struct Failure {
    filigree_error code;
    std::string message;
};

template <class... Args>
[[noreturn]] void fail(filigree_error code, fmt::format_string<Args...> text, Args&&... args) {
    throw Failure{code, fmt::format(text, std::forward<Args>(args)...)};
}

[[noreturn]] void fail(const Error& error);

// The value, or the error as a Failure.
template <class T>
T orFail(Result<T> result) {
    if (!result) fail(result.error());
    return std::move(*result);
}
inline void orFail(const Status& status) {
    if (!status) fail(status.error());
}

}  // namespace filigree::capi
