// The cells that a triangle may touch, row by row.
#pragma once

#include "bake/placement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace filigree::bake {

// floor() for values within +-2^62; the plain conversion is an instruction, the library's floor a call.
inline int64_t floorToInt(double v) {
    const auto whole = static_cast<int64_t>(v);
    return whole - (static_cast<double>(whole) > v ? 1 : 0);
}

// Walks the rows of a triangle widened by `margin` in x and in y. It may be a line or a point.
class TriangleRows {
  public:
    TriangleRows(const std::array<Point<double>, 3>& corners, double margin)
        : margin_(margin), corner_(corners) {
        std::ranges::sort(corner_, [](const Point<double>& a, const Point<double>& b) { return a.y < b.y; });
        slope_ = {slope(corner_[0], corner_[2]), slope(corner_[0], corner_[1]),
                  slope(corner_[1], corner_[2])};
        first_ = floorToInt(corner_[0].y - margin);
        last_ = floorToInt(corner_[2].y + margin);
    }

    [[nodiscard]] int64_t firstRow() const { return first_; }
    [[nodiscard]] int64_t lastRow() const { return last_; }

    // The columns of the cells of rows `first` to `last`, both from firstRow() to lastRow(), that the widened
    // triangle may touch.
    struct Columns {
        int64_t first = 0;
        int64_t last = 0;
    };
    [[nodiscard]] Columns columns(int64_t first, int64_t last) const {
        const double low = std::max(static_cast<double>(first) - margin_, corner_[0].y);
        const double high = std::min(static_cast<double>(last + 1) + margin_, corner_[2].y);
        Extent extent;
        addEnd(low, extent);
        addEnd(high, extent);
        if (corner_[1].y >= low && corner_[1].y <= high) extent.add(corner_[1].x);
        return {floorToInt(extent.left - margin_), floorToInt(extent.right + margin_)};
    }

  private:
    struct Extent {
        double left = 1e300;
        double right = -1e300;
        void add(double x) {
            left = std::min(left, x);
            right = std::max(right, x);
        }
    };

    static double slope(const Point<double>& a, const Point<double>& b) {
        return b.y > a.y ? (b.x - a.x) / (b.y - a.y) : 0;
    }
    static double on(const Point<double>& a, const Point<double>& b, double slope, double y) {
        const double x = a.x + (y - a.y) * slope;
        return std::clamp(x, std::min(a.x, b.x), std::max(a.x, b.x));
    }

    // Adds the triangle's two boundary points at height y; where an edge is level, its ends.
    void addEnd(double y, Extent& extent) const {
        extent.add(on(corner_[0], corner_[2], slope_[0], y));
        if (y <= corner_[1].y) {
            extent.add(on(corner_[0], corner_[1], slope_[1], y));
        } else {
            extent.add(on(corner_[1], corner_[2], slope_[2], y));
        }
        if (y == corner_[0].y) extent.add(corner_[0].x);
        if (y == corner_[2].y) extent.add(corner_[2].x);
    }

    double margin_;
    std::array<Point<double>, 3> corner_;  // by rising y
    std::array<double, 3> slope_;          // of edges 0-2, 0-1, 1-2
    int64_t first_;
    int64_t last_;
};

}  // namespace filigree::bake
