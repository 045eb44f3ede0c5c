#include "bake/micro_polygon.h"

#include <algorithm>

namespace filigree::bake {
namespace {

struct HullPoint {
    Point<double> at;
    uint8_t corner;
    double x;
    double y;
};

double turn(const HullPoint& a, const HullPoint& b, const HullPoint& c) {
    return (b.at.x - a.at.x) * (c.at.y - a.at.y) - (b.at.y - a.at.y) * (c.at.x - a.at.x);
}

// The convex hull by Andrew's monotone chains (1979). Points on an edge stay, which costs nothing but time.
std::vector<HullPoint> hullOf(std::vector<HullPoint> points) {
    std::ranges::sort(points, [](const HullPoint& a, const HullPoint& b) {
        return a.at.x != b.at.x ? a.at.x < b.at.x : a.at.y < b.at.y;
    });
    std::vector<HullPoint> hull;
    const auto chain = [&](auto first, auto last) {
        const size_t start = hull.size();
        for (auto p = first; p != last; ++p) {
            while (hull.size() >= start + 2 && turn(hull[hull.size() - 2], hull.back(), *p) <= 0)
                hull.pop_back();
            hull.push_back(*p);
        }
        hull.pop_back();
    };
    chain(points.begin(), points.end());
    chain(points.rbegin(), points.rend());
    return hull;
}

}  // namespace

WidenedShape::WidenedShape(const std::array<Point<double>, 3>& corners, double guard) {
    if (guard == 0) {
        for (uint8_t k = 0; k < 3; ++k) shape_[size_++] = {k, 0, 0};
        return;
    }
    std::vector<HullPoint> points;
    for (uint8_t k = 0; k < 3; ++k) {
        for (const double x : {-guard, guard}) {
            for (const double y : {-guard, guard}) {
                points.push_back({{corners[k].x + x, corners[k].y + y}, k, x, y});
            }
        }
    }
    for (const HullPoint& p : hullOf(std::move(points))) shape_[size_++] = {p.corner, p.x, p.y};
}

}  // namespace filigree::bake
