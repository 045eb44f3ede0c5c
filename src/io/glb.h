// The GLB container (glTF 2.0 section 4.4): a header and chunks.
#pragma once

#include "filigree/core/result.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace filigree::io {

struct GlbChunk {
    uint32_t type = 0;
    std::span<const uint8_t> bytes;
};

struct Glb {
    std::string_view json;
    std::span<const uint8_t> binary;  // the BIN chunk with its padding; empty without one
    std::vector<GlbChunk> others;     // of unknown type, kept as they stand
};

bool isGlb(std::span<const uint8_t> bytes);

// The chunks of a GLB file, which stay in `bytes`.
Result<Glb> parseGlb(std::span<const uint8_t> bytes);

// A GLB file of `json`, the concatenated `binary` pieces and `others`. ErrorKind::limit above 4 GiB - 1.
Result<std::vector<uint8_t>> makeGlb(std::string_view json, std::span<const std::span<const uint8_t>> binary,
                                     std::span<const GlbChunk> others);

}  // namespace filigree::io
