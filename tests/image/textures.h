// Small random textures.
#pragma once

#include "filigree/image/alpha_image.h"

#include <cstdint>
#include <random>

namespace filigree::image::tests {

constexpr Wrap wraps[] = {Wrap::repeat, Wrap::mirroredRepeat, Wrap::clampToEdge};

// The same numbers in every run.
class Random {
  public:
    explicit Random(uint32_t seed) : engine_(seed) {}
    uint32_t below(uint32_t count) { return engine_() % count; }
    double between(double lo, double hi) { return lo + (hi - lo) * (engine_() >> 8) * 0x1p-24; }

    // Texels of any value, of few values, or of 0 and 65535 alone.
    AlphaTexture texture(uint32_t width, uint32_t height) {
        AlphaTexture texture;
        texture.image = {width, height, std::vector<uint16_t>(size_t{width} * height), 65535};
        const uint32_t kind = below(3);
        for (uint16_t& t : texture.image.texels) {
            t = static_cast<uint16_t>(kind == 0   ? below(65536)
                                      : kind == 1 ? 32766 + below(4)
                                                  : below(2) * 65535);
        }
        texture.wrapU = wraps[below(3)];
        texture.wrapV = wraps[below(3)];
        return texture;
    }

  private:
    std::mt19937 engine_;
};

}  // namespace filigree::image::tests
