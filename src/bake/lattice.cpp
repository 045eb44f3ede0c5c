#include "bake/lattice.h"

namespace filigree::bake {

LatticeFrame::LatticeFrame(const SubTriangle& part, const Placement& placement, double guard) {
    const auto corners = part.corners(placement);
    const double n = static_cast<double>(int64_t{1} << part.height);
    origin = corners[0];
    const double ux = (corners[1].x - origin.x) / n;
    const double uy = (corners[1].y - origin.y) / n;
    const double vx = (corners[2].x - origin.x) / n;
    const double vy = (corners[2].y - origin.y) / n;
    const double area = ux * vy - uy * vx;
    const double size = std::max({std::fabs(ux), std::fabs(uy), std::fabs(vx), std::fabs(vy)});
    a = {vy / area, -vx / area, 0, 0, 0, 0};
    b = {-uy / area, ux / area, 0, 0, 0, 0};
    c = {-a.perX - b.perX, -a.perY - b.perY, n, 0, 0, 0};
    for (Coordinate* coordinate : {&a, &b, &c}) {
        const double steps = coordinate->steps();
        const double thinness = steps * size;
        // Pieces are single precision within their cell; positions are off by the placement's slack; the
        // coefficients lose what `area` cancels.
        coordinate->rounding = steps * (2e-7 + 16 * placement.slack() * (1 + thinness)) +
                               1e-14 * n * thinness * (1 + thinness) + 1e-9;
        coordinate->reach = steps * guard + coordinate->rounding;
        coordinate->length =
            std::sqrt(coordinate->perX * coordinate->perX + coordinate->perY * coordinate->perY);
    }
    density = std::fabs(a.perX * b.perY - a.perY * b.perX);
    rounding = std::max({a.rounding, b.rounding, c.rounding});
    valid = rounding < 1e-2;
}

}  // namespace filigree::bake
