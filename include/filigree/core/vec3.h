// A few words of vector algebra.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace filigree {

// x, y and z.
using Vec3 = std::array<float, 3>;

// Sums, products and lengths in single precision, component by component from x to z.
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

// `p` under a column-major 4 x 4 matrix, as glTF stores them.
inline Vec3 transformed(const std::array<float, 16>& m, const Vec3& p) {
    const auto row = [&](size_t r) { return m[r] * p[0] + m[4 + r] * p[1] + m[8 + r] * p[2] + m[12 + r]; };
    return {row(0), row(1), row(2)};
}

}  // namespace filigree
