// The order in which a picture's pixels are worked on.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace filigree::trace {

inline constexpr uint32_t tileSide = 32;  // pixels

// Calls pixel(x, y) for each pixel of one tile.
template <class Pixel>
void forTile(uint32_t width, uint32_t height, size_t tile, Pixel&& pixel) {
    const uint32_t columns = (width + tileSide - 1) / tileSide;
    const auto left = static_cast<uint32_t>(tile % columns) * tileSide;
    const auto top = static_cast<uint32_t>(tile / columns) * tileSide;
    for (uint32_t y = top; y < std::min(top + tileSide, height); ++y) {
        for (uint32_t x = left; x < std::min(left + tileSide, width); ++x) pixel(x, y);
    }
}

inline size_t tileCount(uint32_t width, uint32_t height) {
    return size_t{(width + tileSide - 1) / tileSide} * ((height + tileSide - 1) / tileSide);
}

}  // namespace filigree::trace
