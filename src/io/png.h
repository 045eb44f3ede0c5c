// PNG through libspng.
#pragma once

#include "filigree/io/image_file.h"

namespace filigree::io {

Result<ImageSize> pngSize(std::span<const uint8_t> bytes);

// The alpha channel; with `greyAsAlpha` the grey of an image that has no alpha.
Result<image::AlphaImage> decodePngAlpha(std::span<const uint8_t> bytes, bool greyAsAlpha);

}  // namespace filigree::io
