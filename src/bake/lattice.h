// A tile's lattice as a frame of coordinates, and pieces of the outline carried into it.
#pragma once

#include "bake/tile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace filigree::bake {

// One lattice coordinate as a function of a point, and how far the guard and rounding reach in it.
struct Coordinate {
    double perX = 0;
    double perY = 0;
    double constant = 0;
    double rounding = 0;  // bounds the error of at(), lattice steps
    double reach = 0;     // guard and rounding, lattice steps
    double length = 0;    // lattice steps for each texel of distance

    [[nodiscard]] double at(double x, double y) const { return constant + perX * x + perY * y; }
    // The most lattice steps for a texel in x and one in y.
    [[nodiscard]] double steps() const { return std::fabs(perX) + std::fabs(perY); }
};

// The lattice coordinates of points relative to the sub-triangle's first corner: micro-triangles lie between
// whole numbers of a, b and c = n - a - b.
struct LatticeFrame {
    Point<double> origin;
    Coordinate a;
    Coordinate b;
    Coordinate c;
    double rounding = 0;  // the worst of the three
    double density = 0;   // square lattice steps for a square texel
    bool valid = false;   // false for triangles too thin to be measured so

    LatticeFrame(const SubTriangle& part, const Placement& placement, double guard);
};

// A closed stretch of a lattice coordinate.
struct Span {
    double low = 0;
    double high = 0;
    Span(double p, double q, double reach) : low(std::min(p, q) - reach), high(std::max(p, q) + reach) {}
    [[nodiscard]] bool overlaps(double from, double to) const { return high >= from && low <= to; }
};

// A piece's chord in the lattice, and how far the outline may lie from it.
class LatticeChord {
  public:
    struct Axis {
        Span outer;    // where the outline and the guard around it may reach
        double inner;  // how far inside a micro-triangle a point of the chord must lie for the outline to
                       // enter, too

        Axis(const Coordinate& coordinate, double p, double q, double bulge)
            : outer(p, q, coordinate.reach + bulge * coordinate.length),
              inner(coordinate.rounding + bulge * coordinate.length) {}
    };
    Axis a;
    Axis b;
    Axis c;

    // From `p` to `q`, relative to the frame's origin.
    LatticeChord(const LatticeFrame& frame, double guard, const Point<double>& p, const Point<double>& q,
                 double bulge)
        : LatticeChord(frame, {frame.a.at(p.x, p.y), frame.b.at(p.x, p.y)},
                       {frame.a.at(q.x, q.y), frame.b.at(q.x, q.y)}, bulge) {
        const double dx = std::fabs(q.x - p.x);
        const double dy = std::fabs(q.y - p.y);
        // Distances to the chord's line are compared as areas: times its length, in lattice units.
        const double lattice = std::fabs(q_.x - p_.x) + std::fabs(q_.y - p_.y);
        area_ = frame.density * (bulge + guard + 2e-7) * (dx + dy) + 8 * frame.rounding * (lattice + 6);
    }

    // The most lattice steps it covers along an axis.
    [[nodiscard]] double extent() const {
        return std::max(std::fabs(q_.x - p_.x) + 2 * a.inner, std::fabs(q_.y - p_.y) + 2 * b.inner);
    }

    // Does the outline, within its bulge of the chord and widened by the guard, meet a micro-triangle? Convex
    // shapes are apart exactly when a line along a side of one of them parts them.
    enum class Meeting { no, yes, unclear };
    [[nodiscard]] Meeting meets(int32_t i, int32_t j, bool flipped) const;

  private:
    LatticeChord(const LatticeFrame& frame, const Point<double>& p, const Point<double>& q, double bulge)
        : a(frame.a, p.x, q.x, bulge),
          b(frame.b, p.y, q.y, bulge),
          c(frame.c, frame.c.constant - p.x - p.y, frame.c.constant - q.x - q.y, bulge),
          p_(p),
          q_(q),
          n_(frame.c.constant) {}

    // True when all corners lie on one side of the chord's line, further than `area` tells.
    [[nodiscard]] bool isBeside(const std::array<Point<double>, 3>& corners, double area) const;

    Point<double> p_;
    Point<double> q_;
    double n_;
    double area_ = 0;
};

// In the innermost loop, so inline.
inline LatticeChord::Meeting LatticeChord::meets(int32_t i, int32_t j, bool flipped) const {
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
inline bool LatticeChord::isBeside(const std::array<Point<double>, 3>& corners, double area) const {
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
