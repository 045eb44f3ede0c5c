#include "filigree/scene/scene.h"

#include <cmath>

namespace filigree::scene {
namespace {

using Vector = std::array<double, 3>;

// The direction part of a column-major transform applied to `v`.
Vector transformed(const std::array<float, 16>& m, const Vector& v) {
    Vector r;
    for (size_t k = 0; k < 3; ++k) r[k] = m[k] * v[0] + m[4 + k] * v[1] + m[8 + k] * v[2];
    return r;
}

double area(const Vector& a, const Vector& b) {
    const Vector c{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    const double twice = std::sqrt(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]);
    return std::isfinite(twice) ? twice / 2 : 0;
}

Vector difference(const std::array<float, 3>& a, const std::array<float, 3>& b) {
    return {double{a[0]} - b[0], double{a[1]} - b[1], double{a[2]} - b[2]};
}

}  // namespace

std::vector<double> worldAreas(const Scene& scene, const Primitive& primitive) {
    std::vector<double> areas(primitive.triangleCount(), 0.0);
    for (const Instance& instance : scene.instances) {
        if (instance.mesh != primitive.meshIndex) continue;
        for (size_t t = 0; t < areas.size(); ++t) {
            const auto& origin = primitive.positions[primitive.indices[3 * t]];
            const auto& first = primitive.positions[primitive.indices[3 * t + 1]];
            const auto& second = primitive.positions[primitive.indices[3 * t + 2]];
            areas[t] += area(transformed(instance.transform, difference(first, origin)),
                             transformed(instance.transform, difference(second, origin)));
        }
    }
    return areas;
}

}  // namespace filigree::scene
