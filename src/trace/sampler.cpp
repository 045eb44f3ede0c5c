#include "trace/sampler.h"

#include <algorithm>
#include <cmath>

namespace filigree::trace {

Sampler::Sampler(const image::AlphaTexture& texture)
    : width_(texture.image.width),
      height_(texture.image.height),
      wrapU_(texture.wrapU),
      wrapV_(texture.wrapV),
      nearest_(texture.filter == image::Filter::nearest) {
    const auto& texels = texture.image.texels;
    if (texture.image.steps == 255) {
        texels8_.resize(texels.size());
        std::ranges::transform(texels, texels8_.begin(),
                               [](uint16_t t) { return static_cast<uint8_t>(t / 257); });
    } else {
        texels16_ = texels;
    }
}

double Sampler::at(double u, double v) const {
    const double half = nearest_ ? 0 : 0.5;
    const double sx = u * width_ - half;
    const double sy = v * height_ - half;
    const double cellX = std::floor(sx);
    const double cellY = std::floor(sy);
    const auto x = static_cast<int64_t>(cellX);
    const auto y = static_cast<int64_t>(cellY);
    const uint32_t left = image::wrapTexel(x, width_, wrapU_);
    const uint32_t low = image::wrapTexel(y, height_, wrapV_);
    if (nearest_) return texel(left, low);
    const uint32_t right = image::wrapTexel(x + 1, width_, wrapU_);
    const uint32_t high = image::wrapTexel(y + 1, height_, wrapV_);
    const double fx = sx - cellX;
    const double lowAlpha = texel(left, low) + (texel(right, low) - texel(left, low)) * fx;
    const double highAlpha = texel(left, high) + (texel(right, high) - texel(left, high)) * fx;
    return lowAlpha + (highAlpha - lowAlpha) * (sy - cellY);
}

}  // namespace filigree::trace
