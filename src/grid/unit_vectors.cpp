#include "grid/unit_vectors.h"

#include <cassert>
#include <cmath>

namespace filigree::grid {
namespace {

constexpr double ringDensity = 38.74;

// About sin(t * pi / 2), with operations that every machine rounds alike.
double quarterSine(double t) {
    const double square = t * t;
    return t * (1.5706268 + square * (-0.6432292 + square * 0.0727102));
}

struct ArcPoint {
    double x;
    double y;
};

// The point at share t of a quarter of the unit circle, from (1, 0) to (0, 1).
ArcPoint onArc(double t) {
    const double x = quarterSine(1 - t);
    const double y = quarterSine(t);
    const double length = std::sqrt(x * x + y * y);
    return {x / length, y / length};
}

UnitVectorRings makeRings() {
    UnitVectorRings rings;
    unsigned next = 0;
    for (unsigned ring = 0; ring <= paperRings; ++ring) {
        const ArcPoint tilt = onArc(double(ring) / paperRings);
        const auto steps = static_cast<unsigned>(ringDensity * tilt.y + 0.5);
        rings.first[ring] = next;
        rings.steps[ring] = steps;
        for (unsigned k = 0; k <= steps; ++k, ++next) {
            const ArcPoint turn = onArc(steps > 0 ? double(k) / steps : 0);
            rings.vectors.x[next] = static_cast<float>(tilt.y * turn.x);
            rings.vectors.y[next] = static_cast<float>(tilt.x);
            rings.vectors.z[next] = static_cast<float>(tilt.y * turn.y);
        }
    }
    assert(next == rings.vectors.x.size());
    return rings;
}

}  // namespace

const UnitVectorRings& unitVectorRings() {
    static const UnitVectorRings rings = makeRings();
    return rings;
}

const UnitVectors& unitVectors() {
    return unitVectorRings().vectors;
}

}  // namespace filigree::grid
