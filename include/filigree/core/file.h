// Whole files in and out.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/result.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace filigree {

// Reads all of `path`. Fails with ErrorKind::file when it cannot be read, ErrorKind::limit above `maxBytes`.
FILIGREE_API Result<std::vector<uint8_t>> readFile(const std::filesystem::path& path,
                                                   uint64_t maxBytes = UINT64_MAX);

// Writes `bytes` to `path` so that the file appears whole or not at all: they go to a temporary file beside
// it, are flushed to disk and renamed. On an error (no permission, disk full) nothing is left behind and a
// file that was there before stays as it was.
FILIGREE_API Status writeFile(const std::filesystem::path& path, std::span<const uint8_t> bytes);
FILIGREE_API Status writeFile(const std::filesystem::path& path, std::string_view text);

// The same with the bytes in pieces, one after another.
FILIGREE_API Status writeFile(const std::filesystem::path& path,
                              std::span<const std::span<const uint8_t>> pieces);

}  // namespace filigree
