// The levels and filters at which a shader may sample a texture.
#pragma once

#include "filigree/core/api.h"
#include "filigree/image/alpha_image.h"

#include <deque>
#include <vector>

namespace filigree::image {

// A texture and some of its coarser mip levels.
class FILIGREE_API MipChain {
  public:
    // Level 0 is `texture` itself, which must outlive the chain, then up to `coarser` more; the chain ends at
    // 1x1 texel.
    MipChain(const AlphaTexture& texture, unsigned coarser);

    [[nodiscard]] const std::vector<const AlphaTexture*>& levels() const { return levels_; }

  private:
    std::deque<AlphaTexture> coarser_;
    std::vector<const AlphaTexture*> levels_;
};

// The filters that `filter` stands for, each linear or nearest.
FILIGREE_API std::vector<Filter> filtersOf(Filter filter);

}  // namespace filigree::image
