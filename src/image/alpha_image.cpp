#include "filigree/image/alpha_image.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>

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
