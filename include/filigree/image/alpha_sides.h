// Which side of a threshold filtered alpha is on, over any convex polygon.
#pragma once

#include "filigree/core/api.h"
#include "filigree/image/alpha_image.h"
#include "filigree/image/extremes.h"
#include "filigree/image/patch.h"
#include "filigree/image/threshold.h"

#include <cstdint>

namespace filigree::image {

// The side of all points of a shape. Where it is not certain that all are alike, `mixed`.
enum class Side : uint8_t { transparent, mixed, opaque };

// Answers for one texture. Exact where no operation of the corners' positions rounds, and never wrong: what
// rounding cannot tell is mixed. Calls may come from several threads at once.
class FILIGREE_API AlphaSides {
  public:
    // The texture must outlive it.
    explicit AlphaSides(const AlphaTexture& texture) : texture_(&texture), extremes_(texture) {}

    // The side of a closed convex polygon in the texture's sample space (outline.h), of at most 12 corners;
    // it may be a line or a point. `filter` must be linear or nearest; with nearest a point on a border
    // between texels counts as either.
    [[nodiscard]] Side over(const PatchPolygon<Bounded>& polygon, Filter filter,
                            const Threshold& threshold) const;

    // The side of every point that reads only texels of cells [x0, x1] x [y0, y1], unwrapped: a bound that
    // costs little. Right for both filters.
    [[nodiscard]] Side roughly(int64_t x0, int64_t x1, int64_t y0, int64_t y1,
                               const Threshold& threshold) const;

    [[nodiscard]] const AlphaTexture& texture() const { return *texture_; }

  private:
    const AlphaTexture* texture_;
    TexelExtremes extremes_;
};

}  // namespace filigree::image
