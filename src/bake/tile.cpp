#include "bake/tile.h"

#include <algorithm>
#include <bit>
#include <cassert>

namespace filigree::bake {

void Plane::setRange(uint32_t first, uint32_t end) {
    while (first < end) {
        const uint32_t take = std::min(end - first, 64 - first % 64);
        const uint64_t mask = take == 64 ? ~uint64_t{0} : (uint64_t{1} << take) - 1;
        words_[first / 64] |= mask << (first % 64);
        first += take;
    }
}

uint32_t Plane::find(bool value, uint32_t from, uint32_t end) const {
    while (from < end) {
        const uint64_t wanted = (value ? words_[from / 64] : ~words_[from / 64]) >> (from % 64);
        if (wanted != 0) return std::min(end, from + static_cast<uint32_t>(std::countr_zero(wanted)));
        from = (from / 64 + 1) * 64;
    }
    return end;
}

void Plane::reset(unsigned height) {
    const size_t used = height > 3 ? size_t{1} << (2 * height - 6) : 1;
    std::fill_n(words_.begin(), used, uint64_t{0});
}

const TileCurve& TileCurve::of(unsigned height) {
    static const std::array<TileCurve, tileLevel + 1> tables{
        TileCurve(0), TileCurve(1), TileCurve(2), TileCurve(3), TileCurve(4), TileCurve(5), TileCurve(6)};
    assert(height <= tileLevel);
    return tables[height];
}

TileCurve::TileCurve(unsigned height)
    : height_(height), index_(size_t{2} << (2 * height), uint16_t{0}), triangle_(size_t{1} << (2 * height)) {
    for (uint32_t k = 0; k < triangle_.size(); ++k) {
        const micromap::LatticeTriangle t = micromap::latticeTriangle(k, height);
        triangle_[k] = t;
        index_[key(t.i, t.j, t.flipped)] = static_cast<uint16_t>(k);
    }
}

}  // namespace filigree::bake
