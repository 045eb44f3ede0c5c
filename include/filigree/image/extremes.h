// The least and greatest texel over rectangles, under any wrap mode.
#pragma once

#include "filigree/core/api.h"
#include "filigree/image/alpha_image.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace filigree::image {

// Texel values, 0..65535.
struct TexelRange {
    uint16_t least = 65535;
    uint16_t most = 0;
    void add(const TexelRange& other) {
        least = std::min(least, other.least);
        most = std::max(most, other.most);
    }
};

// A pyramid of least and greatest texels of 2^k x 2^k blocks.
class FILIGREE_API TexelExtremes {
  public:
    // The texture must outlive the pyramid.
    explicit TexelExtremes(const AlphaTexture& texture);

    // A range that encloses that of the texels [x0, x1] x [y0, y1], unwrapped, both ends included.
    [[nodiscard]] TexelRange over(int64_t x0, int64_t x1, int64_t y0, int64_t y1) const;

  private:
    struct Level {
        uint32_t width = 0;
        uint32_t height = 0;
        std::vector<TexelRange> blocks;
    };
    [[nodiscard]] TexelRange overImage(int64_t x0, int64_t x1, int64_t y0, int64_t y1) const;

    const AlphaTexture* texture_;
    std::vector<Level> levels_;  // level 0 holds blocks of 2x2 texels
};

}  // namespace filigree::image
