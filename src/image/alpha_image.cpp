#include "filigree/image/alpha_image.h"

#include "filigree/core/bytes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>

#include <fmt/format.h>

namespace filigree::image {
namespace {

// The source texels that one coarser texel averages, with weights of sum `total`.
struct Taps {
    std::array<uint32_t, 3> at{};
    std::array<uint64_t, 3> weight{};
};

// Taps of coarser texel `i` on an axis of `size` texels that becomes max(1, size / 2).
Taps tapsOf(uint32_t i, uint32_t size) {
    if (size == 1) return {{0, 0, 0}, {1, 0, 0}};
    if (size % 2 == 0) return {{2 * i, 2 * i + 1, 2 * i + 1}, {1, 1, 0}};
    const uint32_t n = size / 2;
    return {{2 * i, 2 * i + 1, 2 * i + 2}, {n - i, n, i + 1}};
}

constexpr unsigned maxPixelBytes = 4096;

Error usageError(std::string message) {
    return {ErrorKind::usage, std::move(message)};
}

Status checkSize(uint32_t width, uint32_t height) {
    const auto fits = [](uint32_t side) { return side > 0 && side <= maxImageSide; };
    if (fits(width) && fits(height)) return {};
    return usageError(fmt::format("an alpha image of {} x {} texels: expected sides of 1 to {}", width,
                                  height, maxImageSide));
}

uint64_t totalWeight(const Taps& taps) {
    return taps.weight[0] + taps.weight[1] + taps.weight[2];
}

}  // namespace

AlphaImage alphaImageFrom8Bit(uint32_t width, uint32_t height, std::span<const uint8_t> texels) {
    assert(texels.size() == size_t{width} * height);
    AlphaImage image{width, height, std::vector<uint16_t>(texels.size()), 255};
    std::ranges::transform(texels, image.texels.begin(),
                           [](uint8_t a) { return static_cast<uint16_t>(a * 257); });
    return image;
}

Result<AlphaImage> alphaImageFrom(const PixelView& pixels) {
    const uint64_t alphaBytes = pixels.bits / 8;
    const uint64_t packed = uint64_t{pixels.width} * pixels.pixelBytes;
    const uint64_t rowBytes = pixels.rowBytes == 0 ? packed : pixels.rowBytes;
    if (const Status size = checkSize(pixels.width, pixels.height); !size) return size.error();
    if (pixels.bits != 8 && pixels.bits != 16)
        return usageError(fmt::format("alpha of {} bits: expected 8 or 16", pixels.bits));
    if (pixels.pixelBytes == 0 || pixels.pixelBytes > maxPixelBytes ||
        pixels.alphaAt + alphaBytes > pixels.pixelBytes)
        return usageError(fmt::format("alpha at bytes {} to {} of pixels of {} bytes", pixels.alphaAt,
                                      pixels.alphaAt + alphaBytes, pixels.pixelBytes));
    if (rowBytes < packed)
        return usageError(fmt::format("rows of {} bytes: expected at least {} for {} pixels", rowBytes,
                                      packed, pixels.width));
    const uint64_t needed = (packed - pixels.pixelBytes) + pixels.alphaAt + alphaBytes;
    if (pixels.bytes.size() < needed || (pixels.bytes.size() - needed) / rowBytes < pixels.height - 1)
        return usageError(fmt::format("{} bytes for {} x {} pixels of {} bytes, in rows of {}",
                                      pixels.bytes.size(), pixels.width, pixels.height, pixels.pixelBytes,
                                      rowBytes));
    AlphaImage image{pixels.width, pixels.height, {}, pixels.bits == 8 ? 255U : 65535U};
    image.texels.reserve(size_t{pixels.width} * pixels.height);
    for (uint32_t y = 0; y < pixels.height; ++y) {
        const uint8_t* from = pixels.bytes.data() + y * rowBytes + pixels.alphaAt;
        for (uint32_t x = 0; x < pixels.width; ++x, from += pixels.pixelBytes)
            image.texels.push_back(pixels.bits == 8 ? static_cast<uint16_t>(*from * 257)
                                                    : loadLe<uint16_t>(from));
    }
    return image;
}

Status check(const AlphaImage& image) {
    if (const Status size = checkSize(image.width, image.height); !size) return size;
    const uint64_t texels = uint64_t{image.width} * image.height;
    if (image.texels.size() != texels)
        return usageError(fmt::format("an alpha image of {} x {} texels has {} of them", image.width,
                                      image.height, image.texels.size()));
    if (image.steps != 255 && image.steps != 65535)
        return usageError(fmt::format("an alpha image of {} grey steps: expected 255 or 65535", image.steps));
    return {};
}

uint32_t wrapTexel(int64_t coordinate, uint32_t size, Wrap wrap) {
    const int64_t n = size;
    if (coordinate >= 0 && coordinate < n) return static_cast<uint32_t>(coordinate);
    if (wrap == Wrap::clampToEdge) return static_cast<uint32_t>(std::clamp<int64_t>(coordinate, 0, n - 1));
    const int64_t period = wrap == Wrap::repeat ? n : 2 * n;
    int64_t in = coordinate % period;
    if (in < 0) in += period;
    return static_cast<uint32_t>(in < n ? in : period - 1 - in);
}

double sampleBilinear(const AlphaTexture& texture, double x, double y) {
    const double sx = x - 0.5;
    const double sy = y - 0.5;
    const double cellX = std::floor(sx);
    const double cellY = std::floor(sy);
    const double fx = sx - cellX;
    const double fy = sy - cellY;
    const AlphaImage& image = texture.image;
    const auto texel = [&](int64_t dx, int64_t dy) {
        const uint32_t column = wrapTexel(static_cast<int64_t>(cellX) + dx, image.width, texture.wrapU);
        const uint32_t row = wrapTexel(static_cast<int64_t>(cellY) + dy, image.height, texture.wrapV);
        return image.at(column, row) / 65535.0;
    };
    const double low = texel(0, 0) + (texel(1, 0) - texel(0, 0)) * fx;
    const double high = texel(0, 1) + (texel(1, 1) - texel(0, 1)) * fx;
    return low + (high - low) * fy;
}

double sampleNearest(const AlphaTexture& texture, double x, double y) {
    const AlphaImage& image = texture.image;
    return image.at(wrapTexel(static_cast<int64_t>(std::floor(x)), image.width, texture.wrapU),
                    wrapTexel(static_cast<int64_t>(std::floor(y)), image.height, texture.wrapV)) /
           65535.0;
}

AlphaImage halve(const AlphaImage& image) {
    AlphaImage half{std::max(1u, image.width / 2), std::max(1u, image.height / 2), {}, 65535};
    half.texels.resize(size_t{half.width} * half.height);
    for (uint32_t y = 0; y < half.height; ++y) {
        const Taps rows = tapsOf(y, image.height);
        for (uint32_t x = 0; x < half.width; ++x) {
            const Taps columns = tapsOf(x, image.width);
            uint64_t sum = 0;
            for (size_t r = 0; r < 3; ++r) {
                for (size_t c = 0; c < 3; ++c) {
                    if (const uint64_t weight = rows.weight[r] * columns.weight[c]; weight > 0) {
                        sum += weight * image.at(columns.at[c], rows.at[r]);
                    }
                }
            }
            const uint64_t total = totalWeight(rows) * totalWeight(columns);
            half.texels[size_t{y} * half.width + x] = static_cast<uint16_t>((sum + total / 2) / total);
        }
    }
    return half;
}

unsigned coarserLevels(const AlphaImage& image) {
    return static_cast<unsigned>(std::bit_width(std::max(image.width, image.height))) - 1;
}

}  // namespace filigree::image
