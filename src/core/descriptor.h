// An open file of the system.
#pragma once

#include "filigree/core/result.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

namespace filigree {

// What the last system call on `path` says.
inline Error fileError(const std::filesystem::path& path, std::string_view what) {
    return {ErrorKind::file, fmt::format("{}: {}: {}", path.string(), what, std::strerror(errno))};
}

// Owns a descriptor; close() reports the error that a late write may raise.
class Descriptor {
  public:
    explicit Descriptor(int fd) : fd_(fd) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() {
        if (fd_ >= 0) ::close(fd_);
    }
    [[nodiscard]] int get() const { return fd_; }
    bool close() { return ::close(std::exchange(fd_, -1)) == 0; }

  private:
    int fd_;
};

}  // namespace filigree
