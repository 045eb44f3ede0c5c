#include "filigree/bvh/node.h"

#include <cmath>

namespace filigree::bvh {

Box Node::childBox(size_t k) const {
    Box box;
    for (size_t axis = 0; axis < 3; ++axis) {
        box.low[axis] = origin[axis] + std::ldexp(static_cast<float>(low[axis][k]), exponent[axis]);
        box.high[axis] = origin[axis] + std::ldexp(static_cast<float>(high[axis][k]), exponent[axis]);
    }
    return box;
}

}  // namespace filigree::bvh
