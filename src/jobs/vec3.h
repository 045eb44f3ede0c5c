// A few words of vector algebra.
#pragma once

#include <array>
#include <cmath>

namespace filigree::jobs {

using Vec3 = std::array<float, 3>;

inline Vec3 plus(const Vec3& a, const Vec3& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Vec3 minus(const Vec3& a, const Vec3& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Vec3 times(const Vec3& a, float s) {
    return {a[0] * s, a[1] * s, a[2] * s};
}
inline float dot(const Vec3& a, const Vec3& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
// `a` must not be zero.
inline Vec3 normalised(const Vec3& a) {
    return times(a, 1 / std::sqrt(dot(a, a)));
}

}  // namespace filigree::jobs
