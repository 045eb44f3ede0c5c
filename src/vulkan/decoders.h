// Which decoder reads what.
#pragma once

#include "filigree/core/result.h"
#include "filigree/encoding/encoded_set.h"
#include "filigree/quadmap/reader.h"

#include "vulkan/shaders.h"

namespace filigree::vulkan {

Decoder decoderOf(encoding::Encoding encoding);

// ErrorKind::unsupported for the raw formats.
Result<Decoder> decoderOf(quadmap::SquareFormat format);

// Checks every byte of a set, so that no lookup leaves its blocks, and that 32 bits number the descriptors'
// bits.
Status checkSet(const encoding::EncodedView& set);

// The shaders' constants: log2 of a state's bits.
inline uint32_t widthShiftOf(micromap::Format format) {
    return format == micromap::Format::fourState ? 1 : 0;
}

}  // namespace filigree::vulkan
