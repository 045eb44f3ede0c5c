// Alpha images and the way a shader samples them.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/result.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace filigree::image {

// The largest width or height of an image, in texels. Above every API's own limit.
inline constexpr uint32_t maxImageSide = 65536;

// One alpha channel, row 0 at v = 0. A texel t stands for the alpha t / 65535; 8-bit values are stored times
// 257, which is the same number exactly.
struct AlphaImage {
    uint32_t width = 0;            // texels, 1..maxImageSide
    uint32_t height = 0;           // texels, 1..maxImageSide
    std::vector<uint16_t> texels;  // [width * height], row by row
    // How many grey steps the source had: 255 or 65535. An alpha t is then a multiple of 1/steps.
    uint32_t steps = 65535;

    [[nodiscard]] uint16_t at(uint32_t x, uint32_t y) const { return texels[size_t{y} * width + x]; }
};

// An AlphaImage from 8-bit values, `texels` of width * height bytes.
FILIGREE_API AlphaImage alphaImageFrom8Bit(uint32_t width, uint32_t height, std::span<const uint8_t> texels);

// Pixels in memory of the caller's, of which one channel is the alpha: RGBA8, R8, R16, BGRA16 ...
struct PixelView {
    std::span<const uint8_t> bytes;  // row 0 at v = 0; 16-bit values little-endian, at any address
    uint32_t width = 0;              // texels, 1..maxImageSide
    uint32_t height = 0;             // texels, 1..maxImageSide
    unsigned pixelBytes = 4;         // from one pixel to the next
    unsigned alphaAt = 3;            // where in a pixel its alpha begins, in bytes
    unsigned bits = 8;               // of the alpha, 8 or 16
    size_t rowBytes = 0;             // from one row to the next; 0: width * pixelBytes
};

// Reads the alpha of `pixels`, which are not needed afterwards. ErrorKind::usage for sizes out of range, and
// where a row or a pixel would lie outside the bytes.
FILIGREE_API Result<AlphaImage> alphaImageFrom(const PixelView& pixels);

// What the comments of AlphaImage promise; the error is of ErrorKind::usage. Functions that give a Result
// check it themselves.
FILIGREE_API Status check(const AlphaImage& image);

// What a sampler does with texel coordinates outside the image (glTF sampler.wrapS, wrapT).
enum class Wrap : uint8_t { repeat, mirroredRepeat, clampToEdge };

// Which filters a shader may apply. `both` when a sampler's magnification and minification filters differ:
// then a state has to be right under either.
enum class Filter : uint8_t { linear, nearest, both };

// The texel index that `coordinate` reads on an axis of `size` texels, as glTF and Vulkan define the wrap
// modes.
FILIGREE_API uint32_t wrapTexel(int64_t coordinate, uint32_t size, Wrap wrap);

// An alpha image with its sampler. Texture coordinates (u, v) address the point (u * width, v * height) in
// texel space; texel (x, y) has its centre at (x + 0.5, y + 0.5).
struct AlphaTexture {
    AlphaImage image;
    Wrap wrapU = Wrap::repeat;
    Wrap wrapV = Wrap::repeat;
    Filter filter = Filter::linear;
};

// Bilinear alpha at texel-space point (x, y), both finite and within +-2^40, in [0, 1].
FILIGREE_API double sampleBilinear(const AlphaTexture& texture, double x, double y);

// Alpha of the texel that holds (x, y), in [0, 1].
FILIGREE_API double sampleNearest(const AlphaTexture& texture, double x, double y);

// The next coarser mip level by a box filter: max(1, size / 2) texels an axis. An axis of odd size 2n + 1
// uses the three-tap weights (n - i, n, i + 1) / (2n + 1) for texel i, so that every source texel has equal
// influence (docs/spec/bake.md). Values are rounded to the nearest 1/65535.
FILIGREE_API AlphaImage halve(const AlphaImage& image);

// How many mip levels lie below `image`: floor(log2(max(width, height))).
FILIGREE_API unsigned coarserLevels(const AlphaImage& image);

// How a filtered alpha becomes a state.
enum class AlphaMode : uint8_t {
    mask,   // opaque where alpha >= cutoff (glTF MASK)
    blend,  // opaque where alpha is 1, transparent where it is 0 (glTF BLEND)
};

// What "known" means for a micromap: the parameters that a bake is made with and checked against.
struct AlphaTest {
    AlphaMode mode = AlphaMode::mask;
    double cutoff = 0.5;  // >= 0; ignored for blend; above 1 everything is transparent
    double factor = 1.0;  // baseColorFactor.a, in [0, 1]; multiplies the texture's alpha
    unsigned mips = 0;    // a known state also holds at each of this many coarser mip levels
    double guard =
        1.0 / 256;  // texels of each level: a micro-triangle is widened by the square [-guard, guard]^2
};

}  // namespace filigree::image
