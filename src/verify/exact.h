// The judge's exact tier: integer arithmetic on the float texture coordinates, for shapes that come closer to
// the cutoff than rounding can tell, such as those that touch the contour.
#pragma once

#include "filigree/mesh/uv_triangle.h"
#include "filigree/micromap/curve.h"

#include "verify/limits.h"
#include "verify/rounded.h"

namespace filigree::verify {

// The true verdict on a micro-triangle of finite coordinates; only limits that differ (see Limits) leave it
// undecided.
Verdict judgeExactly(const Layer& layer, Filtering filtering, const mesh::UvTriangle& triangle,
                     unsigned level, const micromap::LatticeTriangle& place, double guard,
                     const Limits& limits);

}  // namespace filigree::verify
