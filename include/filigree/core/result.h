// Errors as values: data from outside never throws and never aborts.
#pragma once

#include <cassert>
#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace filigree {

// What kind of thing went wrong. The command line turns `usage` into exit code 2 and the others into 1.
enum class ErrorKind {
    usage,        // an argument is outside its documented range
    file,         // a file cannot be opened, read or written
    format,       // bytes from outside break their format
    unsupported,  // legal input that this build cannot handle
    limit,        // a size that a format or the machine cannot hold
    cancelled,    // the caller asked to stop
};

// One line for a person: the file, the place in it, what was found, what was expected, and the remedy.
struct Error {
    ErrorKind kind = ErrorKind::format;
    std::string message;

    // The same error with `prefix: ` in front, for callers that know more of the place.
    [[nodiscard]] Error within(const std::string& prefix) const { return {kind, prefix + ": " + message}; }
};

// A value or an Error. Asking for the one that is not there is misuse and asserts.
template <class T>
class [[nodiscard]] Result {
  public:
    Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
    Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

    [[nodiscard]] bool ok() const { return state_.index() == 0; }
    explicit operator bool() const { return ok(); }

    T& operator*() { return value(); }
    const T& operator*() const { return value(); }
    T* operator->() { return &value(); }
    const T* operator->() const { return &value(); }

    T& value() {
        assert(ok());
        return *std::get_if<0>(&state_);
    }
    const T& value() const {
        assert(ok());
        return *std::get_if<0>(&state_);
    }
    [[nodiscard]] const Error& error() const {
        assert(!ok());
        return *std::get_if<1>(&state_);
    }

  private:
    std::variant<T, Error> state_;
};

// Success, or an Error.
template <>
class [[nodiscard]] Result<void> {
  public:
    Result() = default;
    Result(Error error) : error_(std::move(error)) {}

    [[nodiscard]] bool ok() const { return !error_; }
    explicit operator bool() const { return ok(); }
    [[nodiscard]] const Error& error() const {
        assert(error_);
        return *error_;
    }

  private:
    std::optional<Error> error_;
};

// Success, or an Error.
using Status = Result<void>;

}  // namespace filigree
