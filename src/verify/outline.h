// Outlines of micro-triangles, widened by the guard, in rounded and in exact arithmetic alike: Number is
// double with one texel = 1, or a big integer with one texel = a power of two.
#pragma once

#include "verify/arithmetic.h"

#include <array>
#include <utility>

namespace filigree::verify {

// A closed line of points; where the shape is convex and thicker than the rounding it runs counter-clockwise
// around it, otherwise it runs through the shape so that each border point has it within the rounding.
template <class Number>
struct Outline {
    std::array<Point<Number>, 12> at;
    unsigned count = 0;

    void push(Point<Number> point) { at[count++] = std::move(point); }
    [[nodiscard]] const Point<Number>& next(unsigned k) const { return at[k + 1 < count ? k + 1 : 0]; }
};

// A point moved to one corner of the square of half-width `guard` around it; corners are numbered
// counter-clockwise from (+, +).
template <class Number>
Point<Number> squareCorner(const Point<Number>& p, unsigned corner, const Number& guard) {
    const bool left = corner == 1 || corner == 2;
    const bool low = corner >= 2;
    return {left ? Number(p.x - guard) : Number(p.x + guard),
            low ? Number(p.y - guard) : Number(p.y + guard)};
}

// The corner of the square that lies farthest outward of a counter-clockwise edge from `a` to `b`.
template <class Number>
unsigned outwardCorner(const Point<Number>& a, const Point<Number>& b) {
    const bool right = !(b.y < a.y);
    const bool high = !(a.x < b.x);
    if (high) return right ? 0 : 1;
    return right ? 3 : 2;
}

// The outline of the Minkowski sum of the triangle and the square [-guard, guard]^2. Triangles that are a
// line or a point are fine.
template <class Number>
Outline<Number> widened(std::array<Point<Number>, 3> c, const Number& guard) {
    Outline<Number> result;
    if (guard == 0) {
        for (auto& corner : c) result.push(std::move(corner));
        return result;
    }
    const Number turn = (c[1].x - c[0].x) * (c[2].y - c[0].y) - (c[1].y - c[0].y) * (c[2].x - c[0].x);
    if (turn < 0) std::swap(c[1], c[2]);
    std::array<std::pair<unsigned, unsigned>, 3>
        edges;  // start vertex and outward corner of the edges with a length
    unsigned count = 0;
    for (unsigned k = 0; k < 3; ++k) {
        const Point<Number>&a = c[k], &b = c[(k + 1) % 3];
        if (a.x != b.x || a.y != b.y) edges[count++] = {k, outwardCorner(a, b)};
    }
    if (count == 0) {
        for (unsigned corner = 0; corner < 4; ++corner) result.push(squareCorner(c[0], corner, guard));
        return result;
    }
    for (unsigned e = 0; e < count; ++e) {
        const auto [vertex, last] = edges[e];
        unsigned corner = edges[(e + count - 1) % count].second;
        for (; corner != last; corner = (corner + 1) % 4) result.push(squareCorner(c[vertex], corner, guard));
        result.push(squareCorner(c[vertex], last, guard));
    }
    return result;
}

// Calls visit(x) for the places where the strip y0 <= y <= y1 may have its leftmost and rightmost points of
// the shape; never where the strip misses it.
template <class Number, class Visit>
void visitStrip(const Outline<Number>& outline, const Number& y0, const Number& y1, Visit&& visit) {
    const auto cross = [&](const Point<Number>& a, const Point<Number>& b, const Number& y) {
        if ((a.y < y && y < b.y) || (b.y < y && y < a.y)) visit(crossing(a, b, y));
    };
    for (unsigned k = 0; k < outline.count; ++k) {
        const Point<Number>&a = outline.at[k], &b = outline.next(k);
        if (!(a.y < y0) && !(y1 < a.y)) visit(asPlace(a.x));
        cross(a, b, y0);
        cross(a, b, y1);
    }
}

}  // namespace filigree::verify
