// How the vertices of a cluster lie on the lattice.
#pragma once

#include "filigree/grid/lattice.h"

#include "grid/cluster_layout.h"

#include <array>
#include <bit>
#include <cstdint>
#include <span>

namespace filigree::grid {

// Values along an axis.
struct OffsetRange {
    int32_t low = 0;
    int32_t high = 0;
    [[nodiscard]] unsigned width() const {  // bits above the lowest
        return static_cast<unsigned>(std::bit_width(static_cast<uint32_t>(high - low)));
    }
};

// `points` are not empty.
std::array<OffsetRange, 3> rangesOf(std::span<const LatticePoint> points);

// An axis whose coordinate has (p a + q b + 16) >> 5 taken off, with a and b the offsets along the others.
struct Tilt {
    unsigned axis = 0;
    std::array<int, 2> slope{};
    OffsetRange range;  // of what is left
};

// The axis and slopes that save the most bits, found from the plane through the points on.
Tilt findTilt(std::span<const LatticePoint> points, const std::array<OffsetRange, 3>& ranges);

}  // namespace filigree::grid
