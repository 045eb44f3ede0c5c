#include "grid/axis_spacing.h"

#include "filigree/grid/lattice.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace filigree::grid {
namespace {

// A spacing from distances that are known up to `slack`: Euclid's algorithm, in which the spacing grows more
// exact the longer the distances are that it divides.
class CommonSpacing {
  public:
    explicit CommonSpacing(double slack) : slack_(slack) {}

    // False once there is none that is clearly above the slack.
    bool take(double distance) {
        if (distance <= slack_) return true;
        if (step_ == 0) {
            longest_ = step_ = distance;
            return true;
        }
        const double count = std::round(distance / step_);
        if (std::abs(distance - count * step_) > slack_ * (1 + count * step_ / longest_)) {
            // The spacing so far is known best, and the new one divides it.
            step_ /= std::round(step_ / divisor(step_, distance));
            if (!(step_ > 64 * slack_)) return false;
        }
        if (distance > longest_) {
            longest_ = distance;
            step_ = distance / std::round(distance / step_);
        }
        return true;
    }
    [[nodiscard]] double step() const { return step_; }

  private:
    [[nodiscard]] double divisor(double a, double b) const {
        while (b > 16 * slack_) {
            const double rest = std::abs(a - std::round(a / b) * b);
            a = b;
            b = rest;
        }
        return a;
    }

    double slack_;
    double step_ = 0;
    double longest_ = 0;
};

// Distances between some coordinates: of neighbours among them, the shortest first, then from the least.
std::vector<double> sampledDistances(const GridMesh& mesh, size_t axis) {
    constexpr size_t most = 1 << 13;
    const size_t apart = 1 + (mesh.vertices.size() + mesh.looseVertices.size()) / most;
    std::vector<double> sample;
    forEachCoordinate(mesh, axis, [&](double value, size_t index) {
        if (index < most / 2 || index % apart == 0) sample.push_back(value);
        return true;
    });
    std::sort(sample.begin(), sample.end());
    std::vector<double> distances;
    for (size_t k = 1; k < sample.size(); ++k) distances.push_back(sample[k] - sample[k - 1]);
    std::sort(distances.begin(), distances.end());
    for (size_t k = 1; k < sample.size(); ++k) distances.push_back(sample[k] - sample[0]);
    return distances;
}

// The first vertex that origin + step * n is not for any n.
std::optional<size_t> firstInexact(const GridMesh& mesh, size_t axis, double origin, double step) {
    std::optional<size_t> first;
    forEachCoordinate(mesh, axis, [&](double value, size_t index) {
        const double point = origin + step * std::round((value - origin) / step);
        if (double{static_cast<float>(point)} != value) first = index;
        return !first;
    });
    return first;
}

bool holdsNearly(const GridMesh& mesh, size_t axis, const AxisCoordinates& coordinates, double step) {
    return forEachCoordinate(mesh, axis, [&](double value, size_t) {
        const double point = coordinates.low + std::round((value - coordinates.low) / step) * step;
        return std::abs(point - value) <= coordinates.rounding();
    });
}

// Numbers near `step` that a person would write: few digits, or one over a whole number.
std::vector<double> likelySteps(double step) {
    const auto digits = [&](int count) {
        return std::strtod(fmt::format("{:.{}g}", step, count).c_str(), nullptr);
    };
    std::vector<double> likely{step};
    for (const double near :
         {1 / std::round(1 / step), digits(4), digits(7), double{static_cast<float>(step)}})
        if (std::abs(near - step) < 1e-4 * step) likely.push_back(near);
    return likely;
}

// The spacing with a step near `step` and an origin at `low` or at a multiple of the step that holds all
// coordinates exactly, or, not exact, the first tried.
AxisSpacing exactSpacing(const GridMesh& mesh, size_t axis, double low, double step) {
    for (const double likely : likelySteps(step))
        for (const double origin : {low, likely * std::round(low / likely)})
            if (!firstInexact(mesh, axis, origin, likely)) return {origin, likely, true, false};
    return {low, step, false, false};
}

// Whether the middle of any three neighbours along a row or column is the mean of the other two; false where
// there are no three.
bool growsEvenly(const GridMesh& mesh, size_t axis, double low, double step) {
    bool any = false;
    const auto at = [&](const VertexGrid& grid, uint64_t vertex) {
        return std::round((double{mesh.vertices[grid.firstVertex + vertex][axis]} - low) / step);
    };
    const auto even = [&](const VertexGrid& grid, uint64_t vertex, uint64_t apart) {
        any = true;
        return at(grid, vertex - apart) + at(grid, vertex + apart) == 2 * at(grid, vertex);
    };
    for (const VertexGrid& grid : mesh.grids)
        for (uint64_t row = 0; row < grid.rows; ++row)
            for (uint64_t column = 0; column < grid.columns; ++column) {
                const uint64_t vertex = row * grid.columns + column;
                if (column > 0 && column + 1 < grid.columns && !even(grid, vertex, 1)) return false;
                if (row > 0 && row + 1 < grid.rows && !even(grid, vertex, grid.columns)) return false;
            }
    return any;
}

// The exponent of the lowest set bit of a number but 0.
int lowestBit(double value) {
    int exponent = 0;
    const double mantissa = std::frexp(value, &exponent);
    const auto bits = static_cast<int64_t>(std::ldexp(std::abs(mantissa), 53));
    int zeros = 0;
    while ((bits >> zeros & 1) == 0) ++zeros;
    return exponent - 53 + zeros;
}

}  // namespace

double AxisCoordinates::rounding() const {
    return std::ldexp(std::max(std::abs(low), std::abs(high)), -22);
}

SpacingSearch findSpacing(const GridMesh& mesh, size_t axis, const AxisCoordinates& coordinates) {
    SpacingSearch found;
    CommonSpacing common(coordinates.rounding());
    // Short distances first: dividing long ones would lose what they know.
    for (const double distance : sampledDistances(mesh, axis))
        if (!common.take(distance)) {
            common = CommonSpacing(coordinates.rounding());
            break;
        }
    double first = 0;
    forEachCoordinate(mesh, axis, [&](double value, size_t index) {
        if (index == 0) first = value;
        if (!common.take(std::abs(value - first))) found.breach = index;
        return !found.breach;
    });
    if (found.breach || common.step() == 0) return found;
    AxisSpacing spacing = exactSpacing(mesh, axis, coordinates.low, common.step());
    if (!spacing.exact) {
        found.breach = firstInexact(mesh, axis, spacing.origin, spacing.step);
        if (!holdsNearly(mesh, axis, coordinates, spacing.step)) return found;
    }
    if (!((coordinates.high - spacing.origin) / spacing.step < latticeLimit - 1)) return found;
    spacing.even = growsEvenly(mesh, axis, spacing.origin, spacing.step);
    found.spacing = spacing;
    return found;
}

std::optional<double> dyadicSpacingOf(const GridMesh& mesh, size_t axis, const AxisCoordinates& coordinates) {
    int exponent = std::numeric_limits<int>::max();
    forEachCoordinate(mesh, axis, [&](double value, size_t) {
        if (value != 0) exponent = std::min(exponent, lowestBit(value));
        return true;
    });
    if (exponent == std::numeric_limits<int>::max()) return std::nullopt;
    const double step = std::ldexp(1.0, exponent);
    if (!((coordinates.high - coordinates.low) / step < latticeLimit)) return std::nullopt;
    return step;
}

}  // namespace filigree::grid
