#include "io/jpeg.h"

#include <memory>
#include <type_traits>

#include <fmt/format.h>
#include <turbojpeg.h>

namespace filigree::io {
namespace {

struct Destroy {
    void operator()(void* handle) const { tjDestroy(handle); }
};
using Decompressor = std::unique_ptr<std::remove_pointer_t<tjhandle>, Destroy>;

Error jpegError(const Decompressor& decompressor) {
    return {ErrorKind::format, fmt::format("JPEG: {}", tjGetErrorStr2(decompressor.get()))};
}

Result<ImageSize> readSize(const Decompressor& decompressor, std::span<const uint8_t> bytes) {
    int width = 0;
    int height = 0;
    int subsampling = 0;
    int space = 0;
    if (decompressor == nullptr || tjDecompressHeader3(decompressor.get(), bytes.data(), bytes.size(), &width,
                                                       &height, &subsampling, &space) != 0) {
        return jpegError(decompressor);
    }
    const ImageSize size{static_cast<uint32_t>(width), static_cast<uint32_t>(height)};
    if (width <= 0 || height <= 0 || size.texels() > maxImageTexels) {
        return Error{ErrorKind::limit, fmt::format("JPEG: {} x {} texels, at most {} are decoded", width,
                                                   height, maxImageTexels)};
    }
    return size;
}

}  // namespace

Result<ImageSize> jpegSize(std::span<const uint8_t> bytes) {
    return readSize(Decompressor(tjInitDecompress()), bytes);
}

Result<scene::ColourImage> decodeJpeg(std::span<const uint8_t> bytes) {
    const Decompressor decompressor(tjInitDecompress());
    const Result<ImageSize> size = readSize(decompressor, bytes);
    if (!size) return size.error();
    scene::ColourImage image{size->width, size->height, std::vector<uint8_t>(size->texels() * 4)};
    // Scans are limited because a small file may hold thousands of them, each as slow as the whole image.
    const int code = tjDecompress2(decompressor.get(), bytes.data(), bytes.size(), image.rgba.data(),
                                   static_cast<int>(size->width), 0, static_cast<int>(size->height),
                                   TJPF_RGBA, TJFLAG_LIMITSCANS);
    if (code != 0 && tjGetErrorCode(decompressor.get()) == TJERR_FATAL) return jpegError(decompressor);
    return image;
}

}  // namespace filigree::io
