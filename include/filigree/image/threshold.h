// Which texels are opaque, and where between texels the side changes.
#pragma once

#include "filigree/core/api.h"
#include "filigree/image/alpha_image.h"

#include <cstdint>
#include <vector>

namespace filigree::image {

// Which texel values t (0..65535) are opaque: t >= lowestOpaque. Between texels bilinear alpha is opaque
// where it is
// >= value, a real number in (lowestOpaque - 1, lowestOpaque].
struct Threshold {
    uint32_t lowestOpaque = 0;  // 0..65536
    double value = 0;
    bool operator==(const Threshold&) const = default;
};

// The thresholds under which all points of a known micro-triangle must be alike (docs/spec/bake.md).
// `vertexAlpha` multiplies the texture's alpha, as AlphaTest::factor does. Usually one; two for blend, and
// for a mask where a texel value meets the cutoff so closely that float and double disagree on its side.
FILIGREE_API std::vector<Threshold> thresholdsOf(const AlphaTest& test, double vertexAlpha, uint32_t steps);

// The threshold that tells the greater side of an unknown micro-triangle: the mask's own; alpha 0.5 for
// blend.
FILIGREE_API Threshold sideThreshold(const AlphaTest& test, double vertexAlpha, uint32_t steps);

}  // namespace filigree::image
