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

LatticeChord::Meeting LatticeChord::meets(int32_t i, int32_t j, bool flipped) const {
    const double sign = flipped ? -1 : 1;
    const Point<double> corner{static_cast<double>(i + (flipped ? 1 : 0)),
                               static_cast<double>(j + (flipped ? 1 : 0))};
    const double sum = i + j + 1;
    if (!a.outer.overlaps(i, i + 1) || !b.outer.overlaps(j, j + 1)) return Meeting::no;
    if (flipped ? !c.outer.overlaps(n_ - sum - 1, n_ - sum) : !c.outer.overlaps(n_ - sum, n_ - sum + 1)) {
        return Meeting::no;
    }
    if (isBeside({corner, {corner.x + sign, corner.y}, {corner.x, corner.y + sign}}, area_))
        return Meeting::no;

    // The triangle that keeps `inner` from each side.
    const double size = 1 - a.inner - b.inner - c.inner;
    if (size <= 0) return Meeting::unclear;
    const Point<double> in{corner.x + sign * a.inner, corner.y + sign * b.inner};
    const Span chordA(p_.x, q_.x, 0);
    const Span chordB(p_.y, q_.y, 0);
    const Span chordSum(p_.x + p_.y, q_.x + q_.y, 0);
    const double far = sign * size;
    const auto clear = [](const Span& span, double from, double to) {
        return span.overlaps(std::min(from, to), std::max(from, to));
    };
    const bool meet = clear(chordA, in.x, in.x + far) && clear(chordB, in.y, in.y + far) &&
                      clear(chordSum, in.x + in.y, in.x + in.y + far) &&
                      !isBeside({in, {in.x + far, in.y}, {in.x, in.y + far}}, 0);
    return meet ? Meeting::yes : Meeting::unclear;
}

// True when all corners lie on one side of the chord's line, further than `area` tells.
bool LatticeChord::isBeside(const std::array<Point<double>, 3>& corners, double area) const {
    double low = 1e300;
    double high = -1e300;
    for (const Point<double>& v : corners) {
        const double turn = (q_.x - p_.x) * (v.y - p_.y) - (q_.y - p_.y) * (v.x - p_.x);
        low = std::min(low, turn);
        high = std::max(high, turn);
    }
    return low > area || high < -area;
}

}  // namespace filigree::bake
