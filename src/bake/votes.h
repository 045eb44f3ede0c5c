// Many samples of a texture at once.
#pragma once

#include "filigree/image/alpha_image.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace filigree::bake {

// Where a set of samples lies: sample k at (x + sign * offsetX[k], y + sign * offsetY[k]) from the texel
// (column, row). All samples must lie between the centres of texels of the image, so that no wrap mode
// matters, and the image must have fewer than 2^30 texels.
struct Votes {
    const image::AlphaImage* image = nullptr;
    uint32_t column = 0;
    uint32_t row = 0;
    float x = 0;
    float y = 0;
    float sign = 1;
    float threshold = 0;  // texel units
};

// How many samples have bilinear alpha >= threshold, in single precision, the same on every instruction set.
// The number of offsets must be a multiple of 16.
size_t countOpaque(const Votes& votes, std::span<const float> offsetX, std::span<const float> offsetY);

}  // namespace filigree::bake
