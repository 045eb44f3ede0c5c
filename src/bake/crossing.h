// Does a piece of the outline cross a micro-triangle? The one question on which known and unknown hang.
#pragma once

#include "filigree/image/outline.h"

#include "bake/micro_polygon.h"

namespace filigree::bake {

// Answers for the micro-triangles of one sub-triangle under one outline. "No" is proven; "yes" may err where
// rounding cannot tell.
class CrossingTest {
  public:
    CrossingTest(const SubTriangle& part, const Placement& placement, const image::Outline& outline,
                 double guard);

    // True unless micro-triangle `t`, widened, surely keeps clear of the outline in the cell (cellX, cellY),
    // whose patch is `patch`. For nearest filtering the outline there is `piece` alone.
    [[nodiscard]] bool crosses(micromap::LatticeTriangle t, int64_t cellX, int64_t cellY,
                               const image::Patch& patch, const image::OutlinePiece& piece) const;

  private:
    template <class Real>
    [[nodiscard]] bool touches(micromap::LatticeTriangle t, int64_t cellX, int64_t cellY,
                               const image::OutlinePiece& piece, double slack) const;

    const SubTriangle* part_;
    const Placement* placement_;
    image::Filter filter_;
    WidenedShape shape_;
};

}  // namespace filigree::bake
