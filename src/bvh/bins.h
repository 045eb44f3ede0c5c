// Binned surface area heuristic: where to cut a set of boxes in two.
#pragma once

#include "bvh/bounds.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace filigree::bvh {

// The price of `count` leaves: one for each node that holds eight of them, so that cuts leave full nodes
// (after the block sizes of Wald, Woop, Benthin and others 2014).
inline double priceOf(size_t count) {
    return static_cast<double>((count + 7) / 8);
}

// Boxes whose centres lie in a bin below `bin` go left.
struct Cut {
    size_t axis = 0;
    size_t bin = 0;
    double cost = 0;
};

// Places of centres along each axis.
class BinLattice {
  public:
    static constexpr size_t binCount = 32;

    explicit BinLattice(const Bounds& centres);
    // Whether the centres differ on this axis.
    [[nodiscard]] bool useful(size_t axis) const { return scale_[axis] > 0; }
    [[nodiscard]] size_t binOf(const Vec3& centre, size_t axis) const {
        const float place = (centre[axis] - low_[axis]) * scale_[axis];
        return place < binCount - 1 ? static_cast<size_t>(place) : binCount - 1;
    }
    [[nodiscard]] bool isLeft(const Vec3& centre, const Cut& cut) const {
        return binOf(centre, cut.axis) < cut.bin;
    }

  private:
    Vec3 low_{};
    Vec3 scale_{};
};

class Bins {
  public:
    void add(const BinLattice& lattice, const Box& box);
    void add(const Bins& other);
    // The best cut that leaves something on both sides; none where all centres are one point.
    [[nodiscard]] std::optional<Cut> best(const BinLattice& lattice) const;

  private:
    struct Bin {
        Bounds bounds;
        size_t count = 0;
    };
    using Axis = std::array<Bin, BinLattice::binCount>;

    static void bestOn(const Axis& bins, size_t axis, std::optional<Cut>& best);

    std::array<Axis, 3> axes_;
};

}  // namespace filigree::bvh
