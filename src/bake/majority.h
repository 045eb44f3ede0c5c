// Which side of an unknown micro-triangle is the greater (docs/spec/bake.md, "The side of an unknown").
#pragma once

#include "filigree/image/outline.h"

#include "bake/tile.h"

#include <cstdint>
#include <vector>

namespace filigree::bake {

// The rule for the micro-triangles of one sub-triangle, which are congruent: each is divided `depth()` times
// more, and the centroids of the 4^depth parts vote; a tie is opaque.
class SideRule {
  public:
    SideRule(const SubTriangle& part, const Placement& placement, const image::Outline& outline);

    [[nodiscard]] bool isOpaque(micromap::LatticeTriangle t) const;

    // Where a part's centroid lies between a triangle's first corner (0, 0) and the others, (1, 0) and (0,
    // 1).
    struct Centroid {
        double i = 0;
        double j = 0;
    };
    // Those of the 4^depth parts, 2 <= depth <= 5.
    static const std::vector<Centroid>& centroids(unsigned depth);

    // At least 2, and deep enough that a part covers at most 4 square texels, but at most 5.
    static unsigned depth(double squareTexels);

  private:
    // True when all samples of the micro-triangle at `corner` read texels of the image as it lies in memory.
    [[nodiscard]] bool liesInside(const Point<double>& corner, double sign, int64_t& column,
                                  int64_t& row) const;

    const SubTriangle* part_;
    const Placement* placement_;
    const image::Outline* outline_;
    std::vector<float> offsetX_;  // of the centroids of an upright micro-triangle from its first corner
    std::vector<float> offsetY_;
    std::array<float, 2> rangeX_{};  // least and most of them
    std::array<float, 2> rangeY_{};
};

}  // namespace filigree::bake
