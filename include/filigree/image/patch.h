// One cell of bilinear alpha, and the exact range of it over a convex polygon.
#pragma once

#include "filigree/core/bounded.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>

namespace filigree::image {

// A point relative to a cell's lowest corner; the cell is [0, 1]^2.
template <class Real>
struct PatchPoint {
    Real x;
    Real y;
};

// A convex polygon of at most `capacity` corners in order. One or two corners are a point or a line. Seven
// corners and four cuts make eleven; rounding may add a few.
template <class Real>
class PatchPolygon {
  public:
    static constexpr size_t capacity = 24;
    PatchPolygon() = default;
    PatchPolygon(const PatchPolygon& other) { *this = other; }
    PatchPolygon& operator=(const PatchPolygon& other) {
        size_ = other.size_;
        std::copy_n(other.points_.begin(), size_, points_.begin());
        return *this;
    }
    void push(const PatchPoint<Real>& p) {
        assert(size_ < capacity);
        points_[size_++] = p;
    }
    [[nodiscard]] size_t size() const { return size_; }
    const PatchPoint<Real>& operator[](size_t k) const { return points_[k]; }

  private:
    std::array<PatchPoint<Real>, capacity> points_;
    size_t size_ = 0;
};

// Bilinear alpha minus a threshold: corner + x * alongX + y * alongY + x * y * twist - threshold, in texel
// units.
struct Patch {
    double corner = 0;
    double alongX = 0;
    double alongY = 0;
    double twist = 0;
    double threshold = 0;  // kept apart: subtracted from a texel it could be rounded away

    // From the four corner texels, integers, and a threshold.
    static Patch of(double a00, double a10, double a01, double a11, double threshold) {
        return {a00, a10 - a00, a01 - a00, (a11 - a01) - (a10 - a00), threshold};
    }

    template <class Real>
    [[nodiscard]] Real at(const PatchPoint<Real>& p) const {
        return ((Real(corner) + Real(alongX) * p.x) + p.y * (Real(alongY) + Real(twist) * p.x)) -
               Real(threshold);
    }
};

// The values that a patch takes, from below and above. A range of Bounded values encloses the exact one.
struct PatchRange {
    double lower = std::numeric_limits<double>::infinity();
    double upper = -std::numeric_limits<double>::infinity();

    [[nodiscard]] bool empty() const { return lower > upper; }
    // True when all values are surely >= 0, resp. < 0, given that each may be wrong by `tolerance`.
    [[nodiscard]] bool isOpaque(double tolerance = 0) const { return lower >= tolerance; }
    [[nodiscard]] bool isTransparent(double tolerance = 0) const { return upper < -tolerance; }

    void add(double value) {
        lower = std::min(lower, value);
        upper = std::max(upper, value);
    }
    void add(const Bounded& value) {
        const bool bounded = std::isfinite(value.value()) && std::isfinite(value.error());
        lower = std::min(lower, bounded ? value.value() - value.error() : -infinity);
        upper = std::max(upper, bounded ? value.value() + value.error() : infinity);
    }

  private:
    static constexpr double infinity = std::numeric_limits<double>::infinity();
};

// True unless `v` is surely below, resp. above `limit`: keeps what rounding cannot tell.
inline bool mayBeAtLeast(const Bounded& v, double limit, double) {
    return v.value() + v.error() >= limit;
}
inline bool mayBeAtLeast(double v, double limit, double slack) {
    return v >= limit - slack;
}
inline bool mayBeAtMost(const Bounded& v, double limit, double) {
    return v.value() - v.error() <= limit;
}
inline bool mayBeAtMost(double v, double limit, double slack) {
    return v <= limit + slack;
}

// True when `v` is surely 0 or more.
inline bool isNotNegative(const Bounded& v) {
    return v.certainlyNotNegative();
}
inline bool isNotNegative(double v) {
    return v >= 0;
}

namespace detail {

// Cuts away the part of `polygon` where sign * (axis - bound) < 0 (Sutherland and Hodgman 1974), but not what
// rounding cannot tell.
template <class Real>
void cut(PatchPolygon<Real>& polygon, double slack, Real PatchPoint<Real>::*axis, double bound, double sign) {
    const auto distance = [&](const PatchPoint<Real>& p) { return Real(sign) * (p.*axis - Real(bound)); };
    const size_t n = polygon.size();
    std::array<bool, PatchPolygon<Real>::capacity> keep;
    size_t kept = 0;
    for (size_t k = 0; k < n; ++k) {
        const Real& at = polygon[k].*axis;
        keep[k] = sign > 0 ? mayBeAtLeast(at, bound, slack) : mayBeAtMost(at, bound, slack);
        kept += keep[k] ? 1 : 0;
    }
    if (kept == n) return;
    PatchPolygon<Real> inside;
    for (size_t k = 0; k < n && kept > 0; ++k) {
        const size_t next = k + 1 < n ? k + 1 : 0;
        const PatchPoint<Real>& p = polygon[k];
        if (keep[k]) inside.push(p);
        if (keep[k] == keep[next]) continue;
        // The kept end may lie outside within rounding; then it is itself the crossing.
        const PatchPoint<Real>& q = polygon[next];
        const Real dp = distance(p);
        const Real t = dp / (dp - distance(q));
        PatchPoint<Real> met{p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)};
        met.*axis = Real(bound);  // exactly, which the sum above may have lost
        inside.push(met);
    }
    polygon = inside;
}

// Adds what the patch takes between p and q: along a segment it is a parabola, whose turning point may lie
// inside. Where rounding cannot tell whether it turns at all, the bound is infinite and both sides count.
template <class Real>
void addEdge(const Patch& patch, const PatchPoint<Real>& p, const PatchPoint<Real>& q, PatchRange& range) {
    const Real dx = q.x - p.x;
    const Real dy = q.y - p.y;
    const Real bend = Real(patch.twist) * (dx * dy);
    const Real slope =
        Real(patch.alongX) * dx + Real(patch.alongY) * dy + Real(patch.twist) * (p.x * dy + p.y * dx);
    const Real endSlope = slope + bend + bend;
    if (isNotNegative(slope) && isNotNegative(endSlope)) return;
    if (isNotNegative(-slope) && isNotNegative(-endSlope)) return;
    if (isNotNegative(bend) && isNotNegative(-bend)) return;  // straight
    const Real turn = -slope / (bend + bend);
    range.add(patch.at(PatchPoint<Real>{p.x + turn * dx, p.y + turn * dy}));
}

}  // namespace detail

// The part of a convex polygon with x0 <= x <= x1 and y0 <= y <= y1. Points that rounding may have put on the
// wrong side stay in: with Real = double those within `slack`.
template <class Real>
PatchPolygon<Real> clipped(const PatchPolygon<Real>& polygon, double x0, double x1, double y0, double y1,
                           double slack = 0) {
    using Point = PatchPoint<Real>;
    PatchPolygon<Real> inside = polygon;
    detail::cut(inside, slack, &Point::x, x0, 1);
    detail::cut(inside, slack, &Point::x, x1, -1);
    detail::cut(inside, slack, &Point::y, y0, 1);
    detail::cut(inside, slack, &Point::y, y1, -1);
    return inside;
}

// The values that `patch` takes on the part of a convex `polygon` inside the cell; empty where they do not
// meet. A bilinear patch has its extremes over a polygon on the polygon's edges, at corners or at a
// parabola's turning point. With Real = Bounded the range encloses the exact one, and is exact where no
// operation rounds. With Real = double and `slack` a bound of the corners' error, in cells, it may be off by
// patchTolerance(patch, slack).
template <class Real>
PatchRange rangeOver(const Patch& patch, const PatchPolygon<Real>& polygon, double slack = 0) {
    const PatchPolygon<Real> inside = clipped(polygon, 0, 1, 0, 1, slack);
    PatchRange range;
    for (size_t k = 0; k < inside.size(); ++k) range.add(patch.at(inside[k]));
    if (patch.twist == 0) return range;
    for (size_t k = 0; k < inside.size(); ++k) {
        detail::addEdge(patch, inside[k], inside[k + 1 < inside.size() ? k + 1 : 0], range);
    }
    return range;
}

// How far off rangeOver() may be in double precision where corners are off by `slack`, in cells.
inline double patchTolerance(const Patch& patch, double slack) {
    const double steepest = std::fabs(patch.alongX) + std::fabs(patch.alongY) + 2 * std::fabs(patch.twist);
    return slack * 4 * steepest + 1e-9;
}

}  // namespace filigree::image
