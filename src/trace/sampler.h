// Alpha textures as an any-hit test reads them.
#pragma once

#include "filigree/image/alpha_image.h"
#include "filigree/scene/scene.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace filigree::trace {

// k / 255.
inline constexpr std::array<double, 256> alphaOfByte = [] {
    std::array<double, 256> alphas{};
    for (size_t k = 0; k < alphas.size(); ++k) alphas[k] = static_cast<double>(k) / 255.0;
    return alphas;
}();

// The alpha of a texture filtered as image::sampleBilinear (image::sampleNearest where the filter is nearest)
// does, bit for bit, from the source's own 8 or 16 bits a texel.
class Sampler {
  public:
    explicit Sampler(const image::AlphaTexture& texture);

    // Reads alpha among the colours of `image`, as a shader does that shades with them, too. Its alphas must
    // be those of `texture`, of 8 bits; it must outlive the sampler.
    Sampler(const image::AlphaTexture& texture, const scene::ColourImage& image);

    Sampler(Sampler&&) = delete;

    // At texture coordinates (u, v); (u * width, v * height) must be within +-2^40.
    [[nodiscard]] double at(double u, double v) const {
        const double sx = u * axisU_.scale - half_;
        const double sy = v * axisV_.scale - half_;
        const int64_t x = floorOf(sx);
        const int64_t y = floorOf(sy);
        // Most points need no wrapping: then texel and right neighbour, row and next row are neighbours.
        if (static_cast<uint64_t>(x) >= axisU_.inner || static_cast<uint64_t>(y) >= axisV_.inner) [[unlikely]]
            return atBorder(sx, sy, x, y);
        const uint8_t* low =
            bytes_ + ((static_cast<size_t>(y) * axisU_.size + static_cast<size_t>(x)) << shift_);
        const uint8_t* high = low + (size_t{axisU_.size} << shift_);
        const size_t right = size_t{1} << shift_;
        return mixed(alphaOfByte[low[0]], alphaOfByte[low[right]], alphaOfByte[high[0]],
                     alphaOfByte[high[right]], sx - static_cast<double>(x), sy - static_cast<double>(y));
    }

    // Of memory that it reads from.
    [[nodiscard]] uint64_t bytes() const {
        return uint64_t{axisU_.size} * axisV_.size * (texels16_.empty() ? 1u << shift_ : 2u);
    }

  private:
    struct Axis {
        Axis(uint32_t texels, image::Wrap how, bool quick)
            : scale(texels), inner(quick ? texels - 1 : 0), size(texels), wrap(how) {}
        double scale;
        uint64_t inner;  // coordinates below need no wrapping; 0: always take the long way
        uint32_t size;
        image::Wrap wrap;
    };
    Sampler(const image::AlphaTexture& texture, bool quick);

    static int64_t floorOf(double x) {
        const auto towardsZero = static_cast<int64_t>(x);
        return towardsZero - (x < static_cast<double>(towardsZero) ? 1 : 0);
    }
    static double mixed(double lowLeft, double lowRight, double highLeft, double highRight, double fx,
                        double fy) {
        const double low = lowLeft + (lowRight - lowLeft) * fx;
        const double high = highLeft + (highRight - highLeft) * fx;
        return low + (high - low) * fy;
    }

    [[nodiscard]] double atBorder(double sx, double sy, int64_t x, int64_t y) const;
    [[nodiscard]] double texel(uint32_t x, uint32_t y) const {
        const size_t place = size_t{y} * axisU_.size + x;
        return texels16_.empty() ? alphaOfByte[bytes_[place << shift_]] : texels16_[place] / 65535.0;
    }

    Axis axisU_;
    Axis axisV_;
    double half_ = 0.5;               // 0: nearest
    const uint8_t* bytes_ = nullptr;  // the first alpha, unless there are 16 bits
    unsigned shift_ = 0;              // log2 of the bytes from one alpha to the next
    std::vector<uint8_t> texels8_;
    std::vector<uint16_t> texels16_;
};

}  // namespace filigree::trace
