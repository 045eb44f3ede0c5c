#include "grid/cluster_tilt.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace filigree::grid {
namespace {

// Sums over the points less their mean.
struct PointMoments {
    std::array<std::array<double, 3>, 3> of{};  // [axis][axis]

    explicit PointMoments(std::span<const LatticePoint> points) {
        std::array<double, 3> mean{};
        for (const LatticePoint& p : points) {
            for (size_t k = 0; k < 3; ++k) mean[k] += p[k];
        }
        for (double& m : mean) m /= static_cast<double>(points.size());
        for (const LatticePoint& p : points) {
            const std::array<double, 3> off{p[0] - mean[0], p[1] - mean[1], p[2] - mean[2]};
            for (size_t j = 0; j < 3; ++j) {
                for (size_t k = 0; k < 3; ++k) of[j][k] += off[j] * off[k];
            }
        }
    }
};

int slopeOf(double above, double below) {
    if (!(below > 0)) return 0;
    return static_cast<int>(
        std::clamp(std::round(32 * above / below), double{leastSlope}, double{mostSlope}));
}

// Those of the plane of least squares through the points.
std::array<int, 2> planeSlopes(const PointMoments& moments, unsigned axis) {
    const auto [a, b] = levelAxes(axis);
    const double aa = moments.of[a][a];
    const double ab = moments.of[a][b];
    const double bb = moments.of[b][b];
    const double ah = moments.of[a][axis];
    const double bh = moments.of[b][axis];
    const double determinant = aa * bb - ab * ab;
    if (!(determinant > 1e-9 * aa * bb)) return {slopeOf(ah, aa), 0};
    return {slopeOf(ah * bb - bh * ab, determinant), slopeOf(bh * aa - ah * ab, determinant)};
}

class TiltSearch {
  public:
    TiltSearch(std::span<const LatticePoint> points, const std::array<OffsetRange, 3>& ranges)
        : points_(points), ranges_(ranges) {}

    [[nodiscard]] Tilt find() const {
        const PointMoments moments(points_);
        Tilt best{0, {0, 0}, ranges_[0]};
        int most = 0;
        for (unsigned axis = 0; axis < 3; ++axis) {
            const Tilt tilt = along(axis, planeSlopes(moments, axis));
            if (gain(tilt) <= most || tilt.range.width() > widestOffset) continue;
            most = gain(tilt);
            best = tilt;
        }
        return most > 0 ? improved(best) : best;
    }

  private:
    [[nodiscard]] int gain(const Tilt& tilt) const {
        return static_cast<int>(ranges_[tilt.axis].width()) - static_cast<int>(tilt.range.width());
    }

    [[nodiscard]] Tilt along(unsigned axis, const std::array<int, 2>& slope) const {
        const auto [a, b] = levelAxes(axis);
        OffsetRange range{std::numeric_limits<int32_t>::max(), std::numeric_limits<int32_t>::min()};
        for (const LatticePoint& p : points_) {
            const int32_t left = p[axis] - tiltOf(slope, p[a] - ranges_[a].low, p[b] - ranges_[b].low);
            range.low = std::min(range.low, left);
            range.high = std::max(range.high, left);
        }
        return {axis, slope, range};
    }

    // Steps to neighbouring slopes while that leaves less.
    [[nodiscard]] Tilt improved(Tilt tilt) const {
        const auto spread = [](const Tilt& t) { return t.range.high - t.range.low; };
        for (int tries = 0; tries < 8; ++tries) {
            const Tilt before = tilt;
            for (const auto& [p, q] : {std::array{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
                const std::array<int, 2> slope{std::clamp(before.slope[0] + p, leastSlope, mostSlope),
                                               std::clamp(before.slope[1] + q, leastSlope, mostSlope)};
                const Tilt next = along(tilt.axis, slope);
                if (spread(next) < spread(tilt)) tilt = next;
            }
            if (tilt.slope == before.slope) break;
        }
        return tilt;
    }

    std::span<const LatticePoint> points_;
    const std::array<OffsetRange, 3>& ranges_;
};

}  // namespace

std::array<OffsetRange, 3> rangesOf(std::span<const LatticePoint> points) {
    std::array<OffsetRange, 3> ranges{};
    for (size_t k = 0; k < 3; ++k) {
        const auto [low, high] = std::ranges::minmax(points, {}, [k](const LatticePoint& p) { return p[k]; });
        ranges[k] = {low[k], high[k]};
    }
    return ranges;
}

Tilt findTilt(std::span<const LatticePoint> points, const std::array<OffsetRange, 3>& ranges) {
    return TiltSearch(points, ranges).find();
}

}  // namespace filigree::grid
