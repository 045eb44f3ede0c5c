// PNG through libspng.
#pragma once

#include "filigree/io/image_file.h"

namespace filigree::io {

Result<ImageSize> pngSize(std::span<const uint8_t> bytes);

// The alpha channel; with `greyAsAlpha` the grey of an image that has no alpha.
Result<image::AlphaImage> decodePngAlpha(std::span<const uint8_t> bytes, bool greyAsAlpha);

// The grey values of a PNG that has nothing but 8 or 16 bits of grey, as they are: 0..255 or 0..65535.
struct GreyImage {
    ImageSize size;
    std::vector<uint16_t> values;  // [width * height]
};
Result<GreyImage> decodePngGrey(std::span<const uint8_t> bytes);

}  // namespace filigree::io
