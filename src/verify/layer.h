// One mip level of an alpha texture as the judge reads it: texels by unwrapped coordinates.
#pragma once

#include "filigree/image/alpha_image.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace filigree::verify {

// The least and the greatest of some texels. Empty while lo > hi.
struct TexelRange {
    uint32_t lo = UINT32_MAX;
    uint32_t hi = 0;

    void add(uint32_t texel) {
        lo = std::min(lo, texel);
        hi = std::max(hi, texel);
    }
    void add(const TexelRange& other) {
        lo = std::min(lo, other.lo);
        hi = std::max(hi, other.hi);
    }
};

// The texels at the corners of a bilinear cell: of (x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1).
using CellTexels = std::array<int32_t, 4>;

// The filtered texel at (u, v) of a cell, both in [0, 1].
inline double bilinear(const CellTexels& t, double u, double v) {
    const double low = t[0] + (t[1] - t[0]) * u;
    const double high = t[2] + (t[3] - t[2]) * u;
    return low + (high - low) * v;
}

// A block of texels by unwrapped coordinates, ends included.
struct TexelBlock {
    int64_t x0, x1, y0, y1;
};

class Layer {
  public:
    // Keeps a reference to `image`.
    Layer(const image::AlphaImage& image, image::Wrap wrapU, image::Wrap wrapV);

    [[nodiscard]] uint32_t width() const { return image_->width; }
    [[nodiscard]] uint32_t height() const { return image_->height; }

    // The range of all texels.
    [[nodiscard]] const TexelRange& whole() const { return whole_; }

    [[nodiscard]] uint32_t texel(int64_t x, int64_t y) const;
    [[nodiscard]] CellTexels cell(int64_t x, int64_t y) const;

    // Adds the texels of `block` to `range`, row by row, until enough(range).
    template <class Enough>
    void addBlock(const TexelBlock& block, TexelRange& range, Enough&& enough) const {
        const Segments columns = segments(block.x0, block.x1, width(), wrapU_);
        const Segments rows = segments(block.y0, block.y1, height(), wrapV_);
        for (unsigned r = 0; r < rows.count; ++r) {
            for (uint32_t y = rows.of[r].first; y <= rows.of[r].last; ++y) {
                addRow(y, columns, range);
                if (enough(range)) return;
            }
        }
    }

  private:
    struct Segment {
        uint32_t first, last;
    };
    // What a run of unwrapped coordinates reads, as at most three runs inside the image.
    struct Segments {
        std::array<Segment, 3> of;
        unsigned count = 0;
    };
    static Segments segments(int64_t first, int64_t last, uint32_t size, image::Wrap wrap);
    static Segments periodicSegments(int64_t first, int64_t last, uint32_t size, bool mirrored);
    void addRow(uint32_t y, const Segments& columns, TexelRange& range) const;

    const image::AlphaImage* image_;
    image::Wrap wrapU_;
    image::Wrap wrapV_;
    std::vector<TexelRange> rows_;  // [height]
    TexelRange whole_;
};

}  // namespace filigree::verify
