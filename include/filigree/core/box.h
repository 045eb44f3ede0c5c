// An axis-aligned box.
#pragma once

#include "filigree/core/vec3.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace filigree {

// Empty where low > high, as it is made.
struct Box {
    Vec3 low{1, 1, 1};
    Vec3 high{0, 0, 0};
    bool operator==(const Box&) const = default;

    [[nodiscard]] bool empty() const { return !(low[0] <= high[0]); }
    [[nodiscard]] float diagonal() const {
        const Vec3 across = minus(high, low);
        return empty() ? 0 : std::sqrt(dot(across, across));
    }
    // k < 8; bit b of k takes the high end of axis b.
    [[nodiscard]] Vec3 corner(unsigned k) const {
        return {(k & 1) != 0 ? high[0] : low[0], (k & 2) != 0 ? high[1] : low[1],
                (k & 4) != 0 ? high[2] : low[2]};
    }
    void extend(const Vec3& point) {
        const bool first = empty();
        for (size_t k = 0; k < 3; ++k) {
            low[k] = first ? point[k] : std::min(low[k], point[k]);
            high[k] = first ? point[k] : std::max(high[k], point[k]);
        }
    }
    void extend(const Box& other) {
        if (other.empty()) return;
        extend(other.low);
        extend(other.high);
    }
};

}  // namespace filigree
