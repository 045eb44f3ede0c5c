// Boxes to build hierarchies over.
#pragma once

#include "filigree/core/box.h"

#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace filigree::bvh {

// `count` boxes up to `side` wide, strewn over a cube `across` wide around `centre`.
inline std::vector<Box> strewnBoxes(size_t count, float across, float side, unsigned seed = 1,
                                    const Vec3& centre = {0, 0, 0}) {
    std::mt19937 random(seed);
    const auto between = [&](float low, float high) {
        return low + (high - low) * (static_cast<float>(random() >> 8) / 16777216.0F);
    };
    std::vector<Box> boxes(count);
    for (Box& box : boxes) {
        for (size_t k = 0; k < 3; ++k) {
            box.low[k] = centre[k] + between(-across / 2, across / 2);
            box.high[k] = box.low[k] + between(0, side);
        }
    }
    return boxes;
}

// Flat boxes side by side on a rolling ground, as tiles of a terrain lie: n x n of them.
inline std::vector<Box> terrainBoxes(size_t n) {
    std::vector<Box> boxes;
    for (size_t y = 0; y < n; ++y) {
        for (size_t x = 0; x < n; ++x) {
            const auto east = static_cast<float>(x);
            const auto south = static_cast<float>(y);
            const float up = 4 * std::sin(east * 0.2F) * std::cos(south * 0.3F);
            boxes.push_back({{east, up - 0.5F, south}, {east + 1, up + 0.5F, south + 1}});
        }
    }
    return boxes;
}

}  // namespace filigree::bvh
