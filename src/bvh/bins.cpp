#include "bvh/bins.h"

namespace filigree::bvh {

BinLattice::BinLattice(const Bounds& centres) {
    for (size_t k = 0; k < 3; ++k) {
        low_[k] = centres.low[k];
        const float across = centres.high[k] - centres.low[k];
        const float scale = static_cast<float>(binCount) / across;
        // What overflows, at either end, counts as one point.
        if (across > 0 && std::isfinite(across) && std::isfinite(scale)) scale_[k] = scale;
    }
}

void Bins::add(const BinLattice& lattice, const Box& box) {
    const Vec3 centre = centreOf(box);
    for (size_t k = 0; k < 3; ++k) {
        if (!lattice.useful(k)) continue;
        Bin& bin = axes_[k][lattice.binOf(centre, k)];
        bin.bounds.extend(box);
        ++bin.count;
    }
}

void Bins::add(const Bins& other) {
    for (size_t k = 0; k < 3; ++k) {
        for (size_t b = 0; b < BinLattice::binCount; ++b) {
            axes_[k][b].bounds.extend(other.axes_[k][b].bounds);
            axes_[k][b].count += other.axes_[k][b].count;
        }
    }
}

std::optional<Cut> Bins::best(const BinLattice& lattice) const {
    std::optional<Cut> best;
    for (size_t k = 0; k < 3; ++k) {
        if (lattice.useful(k)) bestOn(axes_[k], k, best);
    }
    return best;
}

void Bins::bestOn(const Axis& bins, size_t axis, std::optional<Cut>& best) {
    std::array<Bin, BinLattice::binCount> above;  // all bins from here on
    Bin sum;
    for (size_t b = bins.size(); b-- > 1;) {
        sum.bounds.extend(bins[b].bounds);
        sum.count += bins[b].count;
        above[b] = sum;
    }
    Bin below;
    for (size_t b = 1; b < bins.size(); ++b) {
        below.bounds.extend(bins[b - 1].bounds);
        below.count += bins[b - 1].count;
        if (below.count == 0 || above[b].count == 0) continue;
        const double cost =
            below.bounds.area() * priceOf(below.count) + above[b].bounds.area() * priceOf(above[b].count);
        if (!best || cost < best->cost) best = Cut{axis, b, cost};
    }
}

}  // namespace filigree::bvh
