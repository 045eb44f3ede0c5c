// How far a minor axis of a tile follows the dominant one.
#pragma once

#include "grid/tile_plan.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace filigree::grid {

inline constexpr unsigned residualGroups = residualClasses + 1;

// What a group of `count` values from low to high takes on one axis: its bits and, much less, how near it is
// to taking more.
double groupCost(size_t count, int32_t low, int32_t high);

inline constexpr size_t mostResiduals = size_t{Tile::side} * Tile::side;
using ResidualNumbers = std::array<int32_t, mostResiduals>;

// A tile's residuals group by group, axis by axis.
struct GroupedResiduals {
    explicit GroupedResiduals(std::span<const TileResidual> residuals);
    [[nodiscard]] size_t begin(unsigned group) const { return group == 0 ? 0 : ends[group - 1]; }
    [[nodiscard]] size_t count() const { return ends.back(); }

    std::array<ResidualNumbers, 3> value;
    std::array<ResidualNumbers, 3> bend;
    ResidualNumbers x;  // of TileResidual, less 8
    ResidualNumbers y;
    std::array<size_t, residualGroups> ends{};
};

// Their values on the dominant and a minor axis, of a curve.
struct ShearedAxes {
    ShearedAxes(const GroupedResiduals& residuals, unsigned dominant, unsigned minor, unsigned curve);

    const GroupedResiduals& of;
    ResidualNumbers main;
    ResidualNumbers aside;
};

struct Shear {
    int even = 0;    // 1/32
    int column = 0;  // 1/256
    int row = 0;
};
struct ShearChoice {
    Shear shear;
    double cost = 0;
};

double costOfMain(const ShearedAxes& axes);
double costOfShear(const ShearedAxes& axes, const Shear& shear);
// None, or what least squares give: even or growing.
ShearChoice estimateShear(const ShearedAxes& axes);
// The best in reach of steps by one.
ShearChoice refineShear(const ShearedAxes& axes, const Shear& from);

}  // namespace filigree::grid
