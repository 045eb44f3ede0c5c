// How shaders that answer queries one by one are run.
#pragma once

#include "vulkan/buffer.h"
#include "vulkan/kernel.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace filigree::vulkan {

// The push constants of such a shader: which queries a dispatch answers.
struct LookupRange {
    uint32_t first = 0;
    uint32_t count = 0;
};

// Answers `total` queries, in as few dispatches as the device allows, into a buffer that is bound to
// `binding`, the kernel's last, and brings it to `found`. `what` is done, for errors. The other buffers are
// bound already.
Status answerQueries(Device::Data& device, Kernel& kernel, uint32_t binding, size_t total, const char* what,
                     std::span<uint8_t> found);

}  // namespace filigree::vulkan
