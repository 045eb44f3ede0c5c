// The header and the table of sections of a .fil.
#pragma once

#include "filigree/core/result.h"

#include "io/fil_layout.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace filigree::io {

// A section as it is stored; its hash is right.
struct FilSection {
    uint32_t kind = 0;
    bool zstd = false;
    std::span<const uint8_t> stored;
    uint64_t plainBytes = 0;
};

// All sections of kinds that are known, each at most once. Checks the header and the table, that the sections
// fill the file without gaps or surplus, and every hash.
Result<std::vector<FilSection>> readTable(std::span<const uint8_t> file);

}  // namespace filigree::io
