// The rows of a triangle; see canvas.h.
#pragma once

#include "jobs/canvas.h"

#include <algorithm>
#include <cmath>

namespace filigree::jobs {

// The first pixel whose centre is at or right of (below) `coordinate`, within [0, size].
inline uint32_t firstCentre(double coordinate, uint32_t size) {
    return static_cast<uint32_t>(std::clamp(std::ceil(coordinate - 0.5), 0.0, static_cast<double>(size)));
}

// Where the edge from a to b, a above b, meets the row at `y`. Shared edges run the same way in both their
// triangles, so that both find the same place.
inline double crossing(const Pixel& a, const Pixel& b, double y) {
    return a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
}

template <class Span>
void forEachSpan(const std::array<Pixel, 3>& triangle, uint32_t width, uint32_t height, Span&& span) {
    std::array<Pixel, 3> p = triangle;
    std::sort(p.begin(), p.end(),
              [](const Pixel& a, const Pixel& b) { return a.y != b.y ? a.y < b.y : a.x < b.x; });
    const uint32_t end = firstCentre(p[2].y, height);
    for (uint32_t row = firstCentre(p[0].y, height); row < end; ++row) {
        const double y = row + 0.5;
        const double far = crossing(p[0], p[2], y);
        const double near = y < p[1].y ? crossing(p[0], p[1], y) : crossing(p[1], p[2], y);
        const uint32_t first = firstCentre(std::min(near, far), width);
        const uint32_t last = firstCentre(std::max(near, far), width);
        if (first < last) span(row, first, last);
    }
}

}  // namespace filigree::jobs
