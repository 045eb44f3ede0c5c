// zstd frames.
#pragma once

#include "filigree/core/result.h"

#include <cstdint>
#include <span>
#include <vector>

namespace filigree::io {

// One frame that holds `plain`.
std::vector<uint8_t> zstdCompress(std::span<const uint8_t> plain);

// The bytes of `frame`, which must be one whole frame of `plainBytes` bytes. Memory grows as bytes come out,
// so that a frame that lies about its size costs no more than it holds.
Result<std::vector<uint8_t>> zstdDecompress(std::span<const uint8_t> frame, uint64_t plainBytes);

}  // namespace filigree::io
