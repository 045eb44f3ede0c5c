#include "filigree/micromap/curve.h"

#include <algorithm>
#include <cassert>

namespace filigree::micromap {

uint32_t curveIndex(LatticeTriangle triangle, unsigned level) {
    assert(level <= 15 && triangle.i + triangle.j + (triangle.flipped ? 2 : 1) <= (1u << level));
    const uint32_t w = ~(triangle.i + triangle.j) - (triangle.flipped ? 1 : 0);
    return curveIndexOf({triangle.i, triangle.j, w}, level);
}

LatticeTriangle latticeTriangle(uint32_t index, unsigned level) {
    assert(level <= 15 && index < (1ull << (2 * level)));
    const uint32_t n = 1u << level;
    std::array<LatticePoint, 3> p{{{0, 0}, {n, 0}, {0, n}}};
    const auto midpoint = [](LatticePoint a, LatticePoint b) {
        return LatticePoint{(a.i + b.i) / 2, (a.j + b.j) / 2};
    };
    for (unsigned depth = level; depth-- > 0;) p = childCorners(p, (index >> (2 * depth)) & 3, midpoint);
    const uint32_t i = std::min({p[0].i, p[1].i, p[2].i});
    const uint32_t j = std::min({p[0].j, p[1].j, p[2].j});
    const bool upright = std::ranges::find(p, LatticePoint{i, j}) != p.end();
    return {i, j, !upright};
}

}  // namespace filigree::micromap
