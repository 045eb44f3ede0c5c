// A file in place: its bytes without reading them first.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/result.h"

#include <cstdint>
#include <filesystem>
#include <span>

namespace filigree {

// The bytes of a regular file, mapped to memory for reading. They stay at their address when the object
// moves. The file must not be shortened while it is open.
class FILIGREE_API MappedFile {
  public:
    // Fails with ErrorKind::file when `path` cannot be opened or is no regular file.
    static Result<MappedFile> open(const std::filesystem::path& path);

    MappedFile() = default;
    MappedFile(MappedFile&& other) noexcept;
    MappedFile& operator=(MappedFile&& other) noexcept;
    ~MappedFile();

    [[nodiscard]] std::span<const uint8_t> bytes() const { return bytes_; }

  private:
    explicit MappedFile(std::span<const uint8_t> bytes) : bytes_(bytes) {}
    std::span<const uint8_t> bytes_;
};

}  // namespace filigree
