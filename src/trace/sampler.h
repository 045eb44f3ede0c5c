// Alpha textures as an any-hit test reads them.
#pragma once

#include "filigree/image/alpha_image.h"
#include "filigree/mesh/uv_triangle.h"

#include <cstdint>
#include <vector>

namespace filigree::trace {

// The alpha of a texture filtered as image::sampleBilinear (image::sampleNearest where the filter is nearest)
// does, bit for bit, from the source's own 8 or 16 bits a texel.
class Sampler {
  public:
    Sampler() = default;
    explicit Sampler(const image::AlphaTexture& texture);

    // At texture coordinates (u, v); (u * width, v * height) must be within +-2^40.
    [[nodiscard]] double at(double u, double v) const;
    [[nodiscard]] uint64_t bytes() const { return texels8_.size() + 2 * texels16_.size(); }

  private:
    [[nodiscard]] double texel(uint32_t x, uint32_t y) const {
        const size_t place = size_t{y} * width_ + x;
        return texels16_.empty() ? texels8_[place] / 255.0 : texels16_[place] / 65535.0;
    }

    uint32_t width_ = 0;
    uint32_t height_ = 0;
    image::Wrap wrapU_ = image::Wrap::repeat;
    image::Wrap wrapV_ = image::Wrap::repeat;
    bool nearest_ = false;
    std::vector<uint8_t> texels8_;  // one of the two is empty
    std::vector<uint16_t> texels16_;
};

}  // namespace filigree::trace
