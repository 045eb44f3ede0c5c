// Sections to a .fil.
#pragma once

#include "filigree/core/result.h"

#include "io/fil_layout.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace filigree::io {

// The sections of a file to be, and the bytes that were made for them.
class FilSectionList {
  public:
    void add(FilKind kind, std::vector<uint8_t> bytes);
    // `bytes` are the caller's and must outlive this.
    void view(FilKind kind, std::span<const uint8_t> bytes) { sections_.push_back({kind, bytes, {}}); }

    // Writes the file, whole or not at all, and gives its size. With `zstd` each section is compressed that
    // becomes smaller.
    Result<uint64_t> write(const std::filesystem::path& path, bool zstd) &&;
    // The same file in memory.
    std::vector<uint8_t> join(bool zstd) &&;

  private:
    struct Section {
        FilKind kind;
        std::span<const uint8_t> plain;
        std::vector<uint8_t> frame;  // where it is compressed
        [[nodiscard]] std::span<const uint8_t> stored() const { return frame.empty() ? plain : frame; }
    };
    void compress();
    // Header, table and their hash.
    [[nodiscard]] std::vector<uint8_t> table() const;
    // All of the file, one piece after the other.
    [[nodiscard]] std::vector<std::span<const uint8_t>> pieces(std::span<const uint8_t> table) const;

    std::vector<std::vector<uint8_t>> owned_;
    std::vector<Section> sections_;
};

}  // namespace filigree::io
