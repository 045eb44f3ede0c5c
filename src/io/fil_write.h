// Sections to a .fil.
#pragma once

#include "filigree/core/result.h"

#include "io/fil_layout.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace filigree::io {

struct FilSectionOut {
    FilKind kind;
    std::span<const uint8_t> plain;
    std::vector<uint8_t> frame;  // where it is compressed
    [[nodiscard]] std::span<const uint8_t> stored() const { return frame.empty() ? plain : frame; }
};

// Writes the file of the sections and gives its size. With `zstd` each is compressed that becomes smaller.
Result<uint64_t> writeSections(const std::filesystem::path& path, std::vector<FilSectionOut> sections,
                               bool zstd);

}  // namespace filigree::io
