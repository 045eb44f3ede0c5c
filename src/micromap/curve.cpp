#include "filigree/micromap/curve.h"

#include <cassert>

namespace filigree::micromap {

uint32_t curveIndex(LatticeTriangle triangle, unsigned level) {
    assert(level <= 15 && triangle.i + triangle.j + (triangle.flipped ? 2 : 1) <= (1u << level));
    const uint32_t w = ~(triangle.i + triangle.j) - (triangle.flipped ? 1 : 0);
    return curveIndexOf({triangle.i, triangle.j, w}, level);
}

}  // namespace filigree::micromap
