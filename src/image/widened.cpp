#include "filigree/image/widened.h"

#include <algorithm>

namespace filigree::image {
namespace {

struct HullPoint {
    PatchPoint<double> at;
    WidenedCorner corner;
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

std::vector<WidenedCorner> widened(std::span<const PatchPoint<double>> corners, double guard) {
    std::vector<WidenedCorner> shape;
    if (guard == 0) {
        for (size_t k = 0; k < corners.size(); ++k) shape.push_back({static_cast<uint8_t>(k), 0, 0});
        return shape;
    }
    std::vector<HullPoint> points;
    for (size_t k = 0; k < corners.size(); ++k) {
        for (const double x : {-guard, guard}) {
            for (const double y : {-guard, guard}) {
                points.push_back({{corners[k].x + x, corners[k].y + y}, {static_cast<uint8_t>(k), x, y}});
            }
        }
    }
    for (const HullPoint& p : hullOf(std::move(points))) shape.push_back(p.corner);
    return shape;
}

}  // namespace filigree::image
