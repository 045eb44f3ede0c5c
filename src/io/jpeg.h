// JPEG through libjpeg-turbo.
#pragma once

#include "filigree/io/image_file.h"

namespace filigree::io {

Result<ImageSize> jpegSize(std::span<const uint8_t> bytes);

}  // namespace filigree::io
