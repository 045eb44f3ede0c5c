#include "bvh/quantise.h"

#include "bvh/bounds.h"

#include <cassert>
#include <cmath>

namespace filigree::bvh {
namespace {

constexpr double lastPlace = 255;

// The lattice of one axis.
struct AxisLattice {
    double origin;
    int exponent;

    // The least exponent at which 255 steps from `origin`, itself on the lattice, reach `high`. Places are
    // then multiples of the step below 2^24 of them, so that a float holds each exactly.
    static AxisLattice over(float low, float high) {
        assert(std::abs(low) < 0x1p127F && std::abs(high) < 0x1p127F);
        const float largest = std::max(std::abs(low), std::abs(high));
        int exponent = largest > 0 ? std::ilogb(largest) + 1 - 24 : minExponent;
        const double across = double{high} - low;
        if (across > 0) exponent = std::max(exponent, std::ilogb(across) - 7);
        exponent = std::max(exponent, minExponent);
        for (;; ++exponent) {
            const double origin = std::ldexp(std::floor(std::ldexp(double{low}, -exponent)), exponent);
            if (std::ldexp(double{high} - origin, -exponent) <= lastPlace) return {origin, exponent};
        }
    }
    [[nodiscard]] double at(double place) const { return origin + std::ldexp(place, exponent); }
    [[nodiscard]] uint8_t below(float value) const {
        double place = std::floor(std::ldexp(double{value} - origin, -exponent));
        if (at(place) > value) --place;
        return static_cast<uint8_t>(place);
    }
    [[nodiscard]] uint8_t above(float value) const {
        double place = std::ceil(std::ldexp(double{value} - origin, -exponent));
        if (at(place) < value) ++place;
        return static_cast<uint8_t>(place);
    }
};

[[maybe_unused]] bool contains(const Box& outer, const Box& inner) {
    for (size_t k = 0; k < 3; ++k) {
        if (!(outer.low[k] <= inner.low[k] && inner.high[k] <= outer.high[k])) return false;
    }
    return true;
}

}  // namespace

void setBoxes(Node& node, const std::array<Box, width>& children) {
    Bounds bounds;
    for (const Box& child : children)
        if (!child.empty()) bounds.extend(child);
    for (size_t axis = 0; axis < 3; ++axis) {
        const AxisLattice lattice = AxisLattice::over(bounds.low[axis], bounds.high[axis]);
        node.origin[axis] = static_cast<float>(lattice.origin);
        node.exponent[axis] = static_cast<int8_t>(lattice.exponent);
        node.low[axis].fill(static_cast<uint8_t>(lastPlace));
        node.high[axis].fill(0);
        for (size_t k = 0; k < width; ++k) {
            if (children[k].empty()) continue;
            node.low[axis][k] = lattice.below(children[k].low[axis]);
            node.high[axis][k] = lattice.above(children[k].high[axis]);
        }
    }
    for (size_t k = 0; k < width; ++k) assert(children[k].empty() || contains(node.childBox(k), children[k]));
}

}  // namespace filigree::bvh
