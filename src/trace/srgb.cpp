#include "trace/srgb.h"

#include "filigree/trace/grid_part.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace filigree::trace {

uint8_t srgbOf(float linear) {
    const float c = std::clamp(linear, 0.0F, 1.0F);
    const float s = c <= 0.0031308F ? 12.92F * c : 1.055F * std::pow(c, 1 / 2.4F) - 0.055F;
    return static_cast<uint8_t>(std::lround(s * 255));
}

const std::array<float, 256>& linearOfSrgb() {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> made{};
        for (size_t i = 0; i < made.size(); ++i) {
            const float c = static_cast<float>(i) / 255;
            made[i] = c <= 0.04045F ? c / 12.92F : std::pow((c + 0.055F) / 1.055F, 2.4F);
        }
        return made;
    }();
    return table;
}

Vec3 albedoOfSrgb(const std::array<uint8_t, 3>& srgb) {
    const auto& linear = linearOfSrgb();
    return {linear[srgb[0]], linear[srgb[1]], linear[srgb[2]]};
}

}  // namespace filigree::trace
