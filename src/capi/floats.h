// Vertex data in the caller's memory: some floats at each step.
#pragma once

#include <array>
#include <cstddef>
#include <cstring>

namespace filigree::capi {

template <size_t count>
std::array<float, count> floatsAt(const float* values, size_t stride, size_t vertex) {
    std::array<float, count> read;
    const size_t step = stride != 0 ? stride : sizeof read;
    std::memcpy(read.data(), reinterpret_cast<const unsigned char*>(values) + vertex * step, sizeof read);
    return read;
}

}  // namespace filigree::capi
