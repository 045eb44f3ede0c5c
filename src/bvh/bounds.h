// Boxes while a hierarchy is built: cheap to grow.
#pragma once

#include "filigree/core/box.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace filigree::bvh {

// Empty as it is made; then low is above high.
struct Bounds {
    Vec3 low{infinity, infinity, infinity};
    Vec3 high{-infinity, -infinity, -infinity};

    void extend(const Vec3& point) { extend(point, point); }
    void extend(const Bounds& other) { extend(other.low, other.high); }
    void extend(const Box& box) { extend(box.low, box.high); }
    // Half the surface; in double, so that no finite box overflows. Of an empty one 0.
    [[nodiscard]] double area() const {
        if (low[0] > high[0]) return 0;
        const double x = double{high[0]} - low[0];
        const double y = double{high[1]} - low[1];
        const double z = double{high[2]} - low[2];
        return x * y + y * z + z * x;
    }

  private:
    static constexpr float infinity = std::numeric_limits<float>::infinity();

    void extend(const Vec3& otherLow, const Vec3& otherHigh) {
        for (size_t k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], otherLow[k]);
            high[k] = std::max(high[k], otherHigh[k]);
        }
    }
};

// Where a box stands for the choice of a split.
inline Vec3 centreOf(const Box& box) {
    return {box.low[0] * 0.5F + box.high[0] * 0.5F, box.low[1] * 0.5F + box.high[1] * 0.5F,
            box.low[2] * 0.5F + box.high[2] * 0.5F};
}

// A node of the binary tree that a hierarchy is collapsed from.
struct Branch {
    static constexpr uint32_t isLeaf = 0xffffffff;

    Bounds bounds;
    uint32_t left = isLeaf;  // both stand behind it
    uint32_t right = 0;      // of a leaf, what it stands for
};

}  // namespace filigree::bvh
