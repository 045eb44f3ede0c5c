// The one integer lattice that all vertices of a scene are snapped to.
#pragma once

#include "filigree/core/vec3.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace filigree::grid {

// Lattice coordinates, each below 2^24, so that a float holds them exactly.
using LatticePoint = std::array<int32_t, 3>;
inline constexpr int32_t latticeLimit = 1 << 24;

// world = origin + step * point on each axis. Vertices with equal positions get equal points in every record
// that holds them; that is why the decoded surface has no cracks. Rays are traced in lattice coordinates,
// where vertices are exact.
struct Lattice {
    std::array<double, 3> origin{0, 0, 0};  // world units
    std::array<double, 3> step{1, 1, 1};    // world units, positive and finite
    bool operator==(const Lattice&) const = default;

    // The nearest point, each coordinate rounded half away from zero. `position` must lie on the lattice's
    // range [0, latticeLimit).
    [[nodiscard]] LatticePoint pointAt(const Vec3& position) const {
        LatticePoint p{};
        for (size_t k = 0; k < 3; ++k)
            p[k] = static_cast<int32_t>(std::lround((double{position[k]} - origin[k]) / step[k]));
        return p;
    }
    [[nodiscard]] Vec3 positionOf(const LatticePoint& p) const {
        Vec3 position{};
        for (size_t k = 0; k < 3; ++k) position[k] = static_cast<float>(origin[k] + step[k] * p[k]);
        return position;
    }
};

}  // namespace filigree::grid
