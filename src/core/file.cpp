#include "filigree/core/file.h"

#include "core/descriptor.h"

#include <algorithm>
#include <cstdio>

#include <fcntl.h>
#include <sys/stat.h>

namespace filigree {
namespace {

using Pieces = std::span<const std::span<const uint8_t>>;

bool writeAll(int fd, std::span<const uint8_t> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(fd, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return false;
        bytes = bytes.subspan(static_cast<size_t>(written));
    }
    return true;
}

bool writeAll(int fd, Pieces pieces) {
    return std::ranges::all_of(pieces, [fd](auto piece) { return writeAll(fd, piece); });
}

}  // namespace

Result<std::vector<uint8_t>> readFile(const std::filesystem::path& path, uint64_t maxBytes) {
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (file.get() < 0) return fileError(path, "cannot open");
    struct stat info {};
    if (::fstat(file.get(), &info) != 0) return fileError(path, "cannot read");
    if (S_ISDIR(info.st_mode))
        return Error{ErrorKind::file, path.string() + ": is a folder, expected a file"};
    if (info.st_size > 0 && static_cast<uint64_t>(info.st_size) > maxBytes) {
        return Error{ErrorKind::limit, fmt::format("{}: {} bytes, at most {} can be read", path.string(),
                                                   info.st_size, maxBytes)};
    }
    std::vector<uint8_t> bytes(static_cast<size_t>(info.st_size > 0 ? info.st_size : 0) + 1);
    size_t filled = 0;
    for (;;) {  // Grows past st_size for pipes and files that are being written.
        if (filled == bytes.size()) bytes.resize(bytes.size() * 2);
        const ssize_t got = ::read(file.get(), bytes.data() + filled, bytes.size() - filled);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return fileError(path, "cannot read");
        if (got == 0) break;
        filled += static_cast<size_t>(got);
        if (filled > maxBytes) {
            return Error{ErrorKind::limit, fmt::format("{}: more than {} bytes, the most that can be read",
                                                       path.string(), maxBytes)};
        }
    }
    bytes.resize(filled);
    return bytes;
}

Status writeFile(const std::filesystem::path& path, Pieces bytes) {
    std::error_code ignored;
    if (std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored)) {
        // A device or pipe cannot be replaced by a rename.
        const Descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
        if (file.get() < 0 || !writeAll(file.get(), bytes)) return fileError(path, "cannot write");
        return {};
    }
    std::string temporary = path.string() + ".XXXXXX";
    Descriptor file(::mkstemp(temporary.data()));
    if (file.get() < 0) return fileError(path, "cannot write");
    const mode_t mask = ::umask(0);
    ::umask(mask);
    const bool written = writeAll(file.get(), bytes) && ::fchmod(file.get(), 0666 & ~mask) == 0 &&
                         ::fsync(file.get()) == 0 && file.close() &&
                         std::rename(temporary.c_str(), path.c_str()) == 0;
    if (!written) {
        const Error error = fileError(path, "cannot write");
        ::unlink(temporary.c_str());
        return error;
    }
    return {};
}

Status writeFile(const std::filesystem::path& path, std::span<const uint8_t> bytes) {
    return writeFile(path, Pieces(&bytes, 1));
}

Status writeFile(const std::filesystem::path& path, std::string_view text) {
    return writeFile(path, std::span(reinterpret_cast<const uint8_t*>(text.data()), text.size()));
}

}  // namespace filigree
