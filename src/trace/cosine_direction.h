// Directions of diffuse reflection.
#pragma once

#include "filigree/core/vec3.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace filigree::trace {

// About the axis `n` of length 1, with the density of a diffuse reflection (Malley's method); `random` gives
// numbers in [0, 1) by next().
template <class Random>
Vec3 cosineDirection(const Vec3& n, Random& random) {
    const float radius = std::sqrt(random.next());
    const float angle = 2 * std::numbers::pi_v<float> * random.next();
    // A frame without branches: Duff et al., "Building an Orthonormal Basis, Revisited", 2017.
    const float sign = std::copysign(1.0F, n[2]);
    const float a = -1 / (sign + n[2]);
    const float b = n[0] * n[1] * a;
    const Vec3 t{1 + sign * n[0] * n[0] * a, sign * b, -sign * n[0]};
    const Vec3 s{b, sign + n[1] * n[1] * a, -n[1]};
    const float up = std::sqrt(std::max(0.0F, 1 - radius * radius));
    return normalised(
        plus(times(n, up), plus(times(t, radius * std::cos(angle)), times(s, radius * std::sin(angle)))));
}

}  // namespace filigree::trace
