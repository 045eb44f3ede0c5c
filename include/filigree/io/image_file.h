// PNG and JPEG images in, PNG out.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/result.h"
#include "filigree/image/alpha_image.h"
#include "filigree/scene/scene.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace filigree::io {

// The largest image that is decoded, in texels (16384 x 16384). Above it decoding fails with
// ErrorKind::limit.
inline constexpr uint64_t maxImageTexels = uint64_t{1} << 28;

// What the first bytes of an image say. The last two are named in errors, not read.
enum class ImageKind : uint8_t { unknown, png, jpeg, ktx2, webp };
FILIGREE_API ImageKind imageKind(std::span<const uint8_t> bytes);

// The MIME type of a kind, empty for unknown.
FILIGREE_API std::string_view mimeType(ImageKind kind);

// Width and height of a PNG or JPEG in texels, from its header.
struct ImageSize {
    uint32_t width = 0;
    uint32_t height = 0;
    [[nodiscard]] uint64_t texels() const { return uint64_t{width} * height; }
};
FILIGREE_API Result<ImageSize> imageSize(std::span<const uint8_t> bytes);

// A PNG or JPEG as 8-bit colour. 16-bit PNGs lose their low bits.
FILIGREE_API Result<scene::ColourImage> decodePng(std::span<const uint8_t> bytes);
FILIGREE_API Result<scene::ColourImage> decodeJpeg(std::span<const uint8_t> bytes);
FILIGREE_API Result<scene::ColourImage> decodeImage(std::span<const uint8_t> bytes);

// The alpha that a shader sees: exact for PNG at 8 or 16 bits, from an alpha channel or a tRNS chunk; 1
// everywhere for a PNG with neither and for JPEG, of which then only the header is read.
FILIGREE_API Result<image::AlphaImage> decodeAlpha(std::span<const uint8_t> bytes);

// A PNG as an alpha image: its alpha where it has any, otherwise its grey. Colour without alpha is an error.
FILIGREE_API Result<image::AlphaImage> parseAlphaImage(std::span<const uint8_t> bytes);
FILIGREE_API Result<image::AlphaImage> readAlphaImage(const std::filesystem::path& path);

// PNG files. Same input, same bytes. The spans hold width * height values, row by row.
FILIGREE_API Result<std::vector<uint8_t>> encodePng(const scene::ColourImage& image);
FILIGREE_API Result<std::vector<uint8_t>> encodeGreyPng(uint32_t width, uint32_t height,
                                                        std::span<const uint8_t> texels);
FILIGREE_API Result<std::vector<uint8_t>> encodeGreyPng(uint32_t width, uint32_t height,
                                                        std::span<const uint16_t> texels);

}  // namespace filigree::io
