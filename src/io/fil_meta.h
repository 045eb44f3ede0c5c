// The meta section of a .fil.
#pragma once

#include "filigree/core/result.h"
#include "filigree/io/fil.h"
#include "filigree/quadmap/reader.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace filigree::io {

// What the meta section says.
struct FilHead {
    FilMeta meta;
    encoding::Encoding encoding = encoding::Encoding::flat;
    micromap::Format format = micromap::Format::fourState;
    uint32_t mapCount = 0;
    std::optional<quadmap::SquareFormat> squares;  // then the maps are squares and `encoding` means nothing
};

// `meta` of the head as well.
std::vector<uint8_t> encodeMeta(const FilHead& head);

// Checks every field; errors name the byte in the section.
Result<FilHead> decodeMeta(std::span<const uint8_t> bytes);

}  // namespace filigree::io
