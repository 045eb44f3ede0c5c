#include "grid/tile_plan.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace filigree::grid {
namespace {

inline constexpr unsigned groups = residualClasses + 1;

// What a group takes on one axis: its bits and, much less, how near it is to taking more.
double groupCost(size_t count, int32_t low, int32_t high) {
    const unsigned width = widthFor(low, high, evenBias);
    const auto reach = static_cast<double>(std::max(high, -low));
    return static_cast<double>(count) * (width + 0.25 * reach / static_cast<double>(1U << width));
}

unsigned dominantAxis(std::span<const TileResidual> residuals) {
    std::array<double, 3> energy{};
    for (const TileResidual& residual : residuals)
        for (unsigned k = 0; k < 3; ++k) energy[k] += double(residual.value[k]) * residual.value[k];
    return static_cast<unsigned>(std::max_element(energy.begin(), energy.end()) - energy.begin());
}

// Residuals on two axes, group by group.
class GroupedResiduals {
  public:
    GroupedResiduals(std::span<const TileResidual> residuals, unsigned dominant, unsigned minor,
                     unsigned curve) {
        for (unsigned group = 0; group < groups; ++group) {
            for (const TileResidual& residual : residuals)
                if (residual.group == group) {
                    main[count] = straightened(residual, dominant, curve);
                    aside[count] = straightened(residual, minor, curve);
                    x[count] = residual.x - 8;
                    y[count] = residual.y - 8;
                    ++count;
                }
            ends[group] = count;
        }
    }
    [[nodiscard]] size_t begin(unsigned group) const { return group == 0 ? 0 : ends[group - 1]; }

    static constexpr size_t most = Tile::side * Tile::side;
    std::array<int32_t, most> main;
    std::array<int32_t, most> aside;
    std::array<int32_t, most> x;
    std::array<int32_t, most> y;
    std::array<size_t, groups> ends{};
    size_t count = 0;
};

unsigned bestCurve(std::span<const TileResidual> residuals, unsigned axis) {
    unsigned best = 0;
    double least = std::numeric_limits<double>::max();
    for (unsigned curve = 0; curve < 8; ++curve) {
        std::array<int32_t, groups> low{}, high{};
        std::array<size_t, groups> count{};
        for (const TileResidual& residual : residuals) {
            if (residual.group != edgeQuarter && residual.group != cross) continue;
            const int32_t value = straightened(residual, axis, curve);
            low[residual.group] = std::min(low[residual.group], value);
            high[residual.group] = std::max(high[residual.group], value);
            ++count[residual.group];
        }
        double cost = 0;
        for (const unsigned c : {edgeQuarter, cross}) cost += groupCost(count[c], low[c], high[c]);
        if (cost >= least) continue;
        least = cost;
        best = curve;
    }
    return best;
}

// How far a minor axis follows the dominant one.
struct Shear {
    int even = 0;
    int column = 0;
    int row = 0;
};

// Finds the shear of one minor axis.
class ShearSearch {
  public:
    explicit ShearSearch(const GroupedResiduals& residuals) : of_(residuals) {}

    Shear find() {
        Shear best;
        double least = costOf(best);
        for (const unsigned unknowns : {1U, 3U}) take(leastSquares(unknowns), best, least);
        for (unsigned round = 0; round < 4; ++round)
            if (!improve(best, least)) break;
        return best;
    }

  private:
    [[nodiscard]] double costOf(const Shear& shear) const {
        double cost = 0;
        for (unsigned group = 0; group < groups; ++group) {
            int32_t low = 0, high = 0;
            for (size_t k = of_.begin(group); k < of_.ends[group]; ++k) {
                const int32_t slope = 8 * shear.even + shear.column * of_.x[k] + shear.row * of_.y[k];
                const int32_t value =
                    wrappedResidual(wrappedDifference(of_.aside[k], sheared(slope, of_.main[k])));
                low = std::min(low, value);
                high = std::max(high, value);
            }
            cost += groupCost(of_.ends[group] - of_.begin(group), low, high);
        }
        return cost;
    }
    bool take(const Shear& tried, Shear& best, double& least) {
        const double cost = costOf(tried);
        if (cost >= least) return false;
        least = cost;
        best = tried;
        return true;
    }
    // Tries the neighbours of `best`.
    bool improve(Shear& best, double& least) {
        bool better = false;
        for (int Shear::*part : {&Shear::even, &Shear::column, &Shear::row})
            for (const int step : {-1, 1}) {
                Shear tried = best;
                tried.*part += step;
                const int limit = part == &Shear::even ? 32 : 16;
                if (tried.*part < -limit || tried.*part >= limit) continue;
                if (take(tried, best, least)) better = true;
            }
        return better;
    }
    [[nodiscard]] Shear leastSquares(unsigned unknowns) const;

    const GroupedResiduals& of_;
};

// Equations for minor = dominant * (a + s x + t y) / 256.
struct ShearEquations {
    std::array<std::array<double, 3>, 3> square{};
    std::array<double, 3> right{};

    void add(const std::array<double, 3>& terms, double value, double weight) {
        for (unsigned p = 0; p < 3; ++p) {
            for (unsigned q = 0; q < 3; ++q) square[p][q] += weight * terms[p] * terms[q];
            right[p] += weight * terms[p] * value;
        }
    }
    // The first `count` by elimination; unknowns that nothing fixes are 0.
    std::array<double, 3> solve(unsigned count) {
        const double size = square[0][0];
        std::array<double, 3> solution{};
        for (unsigned p = 0; p < count; ++p) {
            if (!(square[p][p] > 1e-9 * size)) return solution;
            for (unsigned row = 0; row < count; ++row) {
                if (row == p) continue;
                const double factor = square[row][p] / square[p][p];
                for (unsigned q = 0; q < count; ++q) square[row][q] -= factor * square[p][q];
                right[row] -= factor * right[p];
            }
        }
        for (unsigned p = 0; p < count; ++p) solution[p] = right[p] / square[p][p];
        return solution;
    }
};

Shear ShearSearch::leastSquares(unsigned unknowns) const {
    // Each group has its own width, so each counts by its own size.
    ShearEquations equations;
    for (unsigned group = 0; group < groups; ++group) {
        double most = 0;
        for (size_t k = of_.begin(group); k < of_.ends[group]; ++k)
            most = std::max(most, std::abs(double(of_.main[k])));
        if (most == 0) continue;
        for (size_t k = of_.begin(group); k < of_.ends[group]; ++k) {
            const double main = of_.main[k] / 256.0;
            equations.add({main, main * of_.x[k], main * of_.y[k]}, of_.aside[k], 1 / (most * most));
        }
    }
    const auto solution = equations.solve(unknowns);
    const auto rounded = [](double value, int limit) {
        return static_cast<int>(std::clamp(std::round(value), double(-limit), double(limit - 1)));
    };
    return {rounded(solution[0] / 8, 32), rounded(solution[1], 16), rounded(solution[2], 16)};
}

}  // namespace

void choosePrediction(std::span<const TileResidual> residuals, TileHeader& head) {
    head.dominant = dominantAxis(residuals);
    head.curve = bestCurve(residuals, head.dominant);
    const auto minors = minorAxes(head.dominant);
    for (unsigned m = 0; m < 2; ++m) {
        const bool isFlat =
            std::all_of(residuals.begin(), residuals.end(), [&](const TileResidual& residual) {
                return residual.value[minors[m]] == 0 && residual.bend[minors[m]] == 0;
            });
        if (isFlat) continue;
        const GroupedResiduals grouped(residuals, head.dominant, minors[m], head.curve);
        const Shear shear = ShearSearch(grouped).find();
        head.shear[m] = shear.even;
        head.shearColumn[m] = shear.column;
        head.shearRow[m] = shear.row;
    }
}

}  // namespace filigree::grid
