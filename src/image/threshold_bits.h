// Texels against a threshold, a bit each.
#pragma once

#include <cstddef>
#include <cstdint>

namespace filigree::image {

// Sets bit k of `bits` (least significant first in 64-bit words) where texels[k] >= lowest, for k < count;
// other bits of the (count + 63) / 64 words become 0. The same on every instruction set.
void thresholdBits(const uint16_t* texels, size_t count, uint32_t lowest, uint64_t* bits);

}  // namespace filigree::image
