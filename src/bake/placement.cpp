#include "bake/placement.h"

#include <algorithm>
#include <cmath>

namespace filigree::bake {

bool isPlaceable(const mesh::UvTriangle& triangle, uint32_t width, uint32_t height) {
    for (const float alpha : triangle.alpha) {
        if (!std::isfinite(alpha)) return false;
    }
    return std::ranges::all_of(
        triangle.uv, [&](const mesh::Uv& uv) { return image::isPlaceable(uv.u, uv.v, width, height); });
}

}  // namespace filigree::bake
