#include "filigree/mesh/uv_triangle.h"

#include <cmath>

namespace filigree::mesh {

bool isFinite(const UvTriangle& triangle) {
    for (const Uv& uv : triangle.uv) {
        if (!std::isfinite(uv.u) || !std::isfinite(uv.v)) return false;
    }
    return true;
}

}  // namespace filigree::mesh
