#include "grid/tile_shear.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace filigree::grid {
namespace {

// Of `count` numbers.
double rangeCost(const int32_t* numbers, size_t count) {
    int32_t low = 0, high = 0;
    for (size_t k = 0; k < count; ++k) {
        low = std::min(low, numbers[k]);
        high = std::max(high, numbers[k]);
    }
    return groupCost(count, low, high);
}

bool takeShear(const ShearedAxes& axes, const Shear& tried, ShearChoice& best) {
    const double cost = costOfShear(axes, tried);
    if (cost >= best.cost) return false;
    best = {tried, cost};
    return true;
}

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

// Each group has its own width, so each counts by its own size.
ShearEquations equationsOf(const ShearedAxes& axes) {
    const GroupedResiduals& of = axes.of;
    ShearEquations equations;
    for (unsigned group = 0; group < residualGroups; ++group) {
        double most = 0;
        for (size_t k = of.begin(group); k < of.ends[group]; ++k)
            most = std::max(most, std::abs(double(axes.main[k])));
        if (most == 0) continue;
        for (size_t k = of.begin(group); k < of.ends[group]; ++k) {
            const double main = axes.main[k] / 256.0;
            equations.add({main, main * of.x[k], main * of.y[k]}, axes.aside[k], 1 / (most * most));
        }
    }
    return equations;
}

// Tries the neighbours of `best`.
bool improveShear(const ShearedAxes& axes, ShearChoice& best) {
    bool better = false;
    for (int Shear::*part : {&Shear::even, &Shear::column, &Shear::row})
        for (const int step : {-1, 1}) {
            Shear tried = best.shear;
            tried.*part += step;
            const int limit = part == &Shear::even ? 32 : 16;
            if (tried.*part < -limit || tried.*part >= limit) continue;
            if (takeShear(axes, tried, best)) better = true;
        }
    return better;
}

}  // namespace

double groupCost(size_t count, int32_t low, int32_t high) {
    const unsigned width = widthFor(low, high, evenBias);
    const auto reach = static_cast<double>(std::max(high, -low));
    return static_cast<double>(count) * (width + 0.25 * reach / static_cast<double>(1U << width));
}

GroupedResiduals::GroupedResiduals(std::span<const TileResidual> residuals) {
    for (const TileResidual& residual : residuals) ++ends[residual.group];
    for (unsigned group = 1; group < residualGroups; ++group) ends[group] += ends[group - 1];
    std::array<size_t, residualGroups> next{};
    for (unsigned group = 0; group < residualGroups; ++group) next[group] = begin(group);
    for (const TileResidual& residual : residuals) {
        const size_t at = next[residual.group]++;
        for (unsigned k = 0; k < 3; ++k) {
            value[k][at] = residual.value[k];
            bend[k][at] = residual.bend[k];
        }
        x[at] = residual.x - 8;
        y[at] = residual.y - 8;
    }
}

ShearedAxes::ShearedAxes(const GroupedResiduals& residuals, unsigned dominant, unsigned minor, unsigned curve)
    : of(residuals) {
    for (size_t k = 0; k < of.count(); ++k) {
        main[k] = wrappedResidual(of.value[dominant][k] - curveOf(curve, of.bend[dominant][k]));
        aside[k] = wrappedResidual(of.value[minor][k] - curveOf(curve, of.bend[minor][k]));
    }
}

double costOfMain(const ShearedAxes& axes) {
    double cost = 0;
    for (unsigned group = 0; group < residualGroups; ++group)
        cost += rangeCost(&axes.main[axes.of.begin(group)], axes.of.ends[group] - axes.of.begin(group));
    return cost;
}

double costOfShear(const ShearedAxes& axes, const Shear& shear) {
    const GroupedResiduals& of = axes.of;
    ResidualNumbers less;
    for (size_t k = 0; k < of.count(); ++k) {
        const int32_t slope = 8 * shear.even + shear.column * of.x[k] + shear.row * of.y[k];
        less[k] = wrappedResidual(wrappedDifference(axes.aside[k], sheared(slope, axes.main[k])));
    }
    double cost = 0;
    for (unsigned group = 0; group < residualGroups; ++group)
        cost += rangeCost(&less[of.begin(group)], of.ends[group] - of.begin(group));
    return cost;
}

ShearChoice estimateShear(const ShearedAxes& axes) {
    ShearChoice best{{}, costOfShear(axes, {})};
    const ShearEquations equations = equationsOf(axes);
    const auto rounded = [](double value, int limit) {
        return static_cast<int>(std::clamp(std::round(value), double(-limit), double(limit - 1)));
    };
    for (const unsigned unknowns : {1U, 3U}) {
        const auto solution = ShearEquations(equations).solve(unknowns);
        takeShear(axes, {rounded(solution[0] / 8, 32), rounded(solution[1], 16), rounded(solution[2], 16)},
                  best);
    }
    return best;
}

ShearChoice refineShear(const ShearedAxes& axes, const Shear& from) {
    ShearChoice best{from, costOfShear(axes, from)};
    for (unsigned round = 0; round < 4; ++round)
        if (!improveShear(axes, best)) break;
    return best;
}

}  // namespace filigree::grid
