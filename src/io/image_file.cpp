#include "filigree/io/image_file.h"

#include "filigree/core/file.h"

#include "io/jpeg.h"
#include "io/png.h"

#include <algorithm>
#include <array>

namespace filigree::io {
namespace {

bool startsWith(std::span<const uint8_t> bytes, std::string_view magic) {
    return bytes.size() >= magic.size() &&
           std::equal(magic.begin(), magic.end(), bytes.begin(),
                      [](char a, uint8_t b) { return static_cast<uint8_t>(a) == b; });
}

Error unreadable(ImageKind kind) {
    switch (kind) {
        case ImageKind::ktx2:
            return {ErrorKind::unsupported, "KTX2 images are not read; convert to PNG"};
        case ImageKind::webp:
            return {ErrorKind::unsupported, "WebP images are not read; convert to PNG"};
        default:
            return {ErrorKind::format, "neither PNG nor JPEG by its first bytes"};
    }
}

}  // namespace

ImageKind imageKind(std::span<const uint8_t> bytes) {
    if (startsWith(bytes, "\x89PNG\r\n\x1A\n")) return ImageKind::png;
    if (startsWith(bytes, "\xFF\xD8\xFF")) return ImageKind::jpeg;
    if (startsWith(bytes, "\xABKTX 20\xBB\r\n\x1A\n")) return ImageKind::ktx2;
    if (startsWith(bytes, "RIFF") && bytes.size() >= 12 && startsWith(bytes.subspan(8), "WEBP")) {
        return ImageKind::webp;
    }
    return ImageKind::unknown;
}

std::string_view mimeType(ImageKind kind) {
    constexpr std::array<std::string_view, 5> types{"", "image/png", "image/jpeg", "image/ktx2",
                                                    "image/webp"};
    return types[static_cast<size_t>(kind)];
}

Result<ImageSize> imageSize(std::span<const uint8_t> bytes) {
    const ImageKind kind = imageKind(bytes);
    if (kind == ImageKind::png) return pngSize(bytes);
    if (kind == ImageKind::jpeg) return jpegSize(bytes);
    return unreadable(kind);
}

Result<scene::ColourImage> decodeImage(std::span<const uint8_t> bytes) {
    const ImageKind kind = imageKind(bytes);
    if (kind == ImageKind::png) return decodePng(bytes);
    if (kind == ImageKind::jpeg) return decodeJpeg(bytes);
    return unreadable(kind);
}

Result<image::AlphaImage> decodeAlpha(std::span<const uint8_t> bytes) {
    if (imageKind(bytes) == ImageKind::png) return decodePngAlpha(bytes, false);
    const Result<ImageSize> size = imageSize(bytes);
    if (!size) return size.error();
    return image::AlphaImage{size->width, size->height, std::vector<uint16_t>(size->texels(), 65535), 255};
}

Result<image::AlphaImage> readAlphaImage(const std::filesystem::path& path) {
    const Result<std::vector<uint8_t>> bytes = readFile(path, UINT32_MAX);
    if (!bytes) return bytes.error();
    Result<image::AlphaImage> alpha = parseAlphaImage(*bytes);
    if (!alpha) return alpha.error().within(path.string());
    return alpha;
}

Result<image::AlphaImage> parseAlphaImage(std::span<const uint8_t> bytes) {
    const ImageKind kind = imageKind(bytes);
    if (kind == ImageKind::jpeg) return Error{ErrorKind::unsupported, "a JPEG has no alpha, expected a PNG"};
    if (kind != ImageKind::png) return unreadable(kind);
    return decodePngAlpha(bytes, true);
}

}  // namespace filigree::io
