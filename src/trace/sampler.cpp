#include "trace/sampler.h"

#include <algorithm>
#include <cassert>

namespace filigree::trace {
namespace {

// As image::wrapTexel, with a division of 32 bits where that is enough.
uint32_t wrapped(int64_t coordinate, uint32_t size, image::Wrap wrap) {
    if (coordinate >= 0 && coordinate < size) return static_cast<uint32_t>(coordinate);
    if (wrap != image::Wrap::repeat || coordinate != static_cast<int32_t>(coordinate))
        return image::wrapTexel(coordinate, size, wrap);
    if ((size & (size - 1)) == 0) return static_cast<uint32_t>(coordinate) & (size - 1);
    const int32_t in = static_cast<int32_t>(coordinate) % static_cast<int32_t>(size);
    return static_cast<uint32_t>(in < 0 ? in + static_cast<int32_t>(size) : in);
}

bool isNearest(const image::AlphaTexture& texture) {
    return texture.filter == image::Filter::nearest;
}

}  // namespace

Sampler::Sampler(const image::AlphaTexture& texture, bool quick)
    : axisU_(texture.image.width, texture.wrapU, quick),
      axisV_(texture.image.height, texture.wrapV, quick),
      half_(isNearest(texture) ? 0 : 0.5) {}

Sampler::Sampler(const image::AlphaTexture& texture)
    : Sampler(texture, texture.image.steps == 255 && !isNearest(texture)) {
    const auto& texels = texture.image.texels;
    if (texture.image.steps != 255) {
        texels16_ = texels;
        return;
    }
    texels8_.resize(texels.size());
    std::ranges::transform(texels, texels8_.begin(),
                           [](uint16_t t) { return static_cast<uint8_t>(t / 257); });
    bytes_ = texels8_.data();
}

Sampler::Sampler(const image::AlphaTexture& texture, const scene::ColourImage& image)
    : Sampler(texture, !isNearest(texture)) {
    assert(texture.image.steps == 255 && image.width == axisU_.size && image.height == axisV_.size);
    bytes_ = image.rgba.data() + 3;
    shift_ = 2;
}

double Sampler::atBorder(double sx, double sy, int64_t x, int64_t y) const {
    const uint32_t left = wrapped(x, axisU_.size, axisU_.wrap);
    const uint32_t low = wrapped(y, axisV_.size, axisV_.wrap);
    if (half_ == 0) return texel(left, low);
    const uint32_t right = wrapped(x + 1, axisU_.size, axisU_.wrap);
    const uint32_t high = wrapped(y + 1, axisV_.size, axisV_.wrap);
    return mixed(texel(left, low), texel(right, low), texel(left, high), texel(right, high),
                 sx - static_cast<double>(x), sy - static_cast<double>(y));
}

}  // namespace filigree::trace
