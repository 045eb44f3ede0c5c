// The states of a texture's cells.
#pragma once

#include "filigree/encoding/bitmask.h"
#include "filigree/image/patch.h"
#include "filigree/image/threshold.h"

#include <cstdint>
#include <deque>
#include <vector>

namespace filigree::encoding::bitmask {

class Cells {
  public:
    // The source's texture must outlive the cells.
    explicit Cells(const BitmaskSource& source);

    [[nodiscard]] const BitmaskAxis& columns() const { return columns_; }
    [[nodiscard]] const BitmaskAxis& rows() const { return rows_; }

    // By number of stored column and row.
    [[nodiscard]] micromap::State stateOf(uint32_t column, uint32_t row) const;
    [[nodiscard]] bool sideOf(uint32_t column, uint32_t row) const;  // of the centre; true: opaque

  private:
    // What a cell, widened by the guard, covers of one axis of a mip level.
    struct Extent {
        double low = 0;  // in sample space, rounded outwards
        double high = 0;
        int64_t firstTexel = 0;  // that nearest filtering may read
        int64_t lastTexel = 0;
    };
    // One mip level.
    struct Level {
        const image::AlphaTexture* texture;
        std::vector<image::Threshold> thresholds;
        std::vector<Extent> columns;  // by stored column
        std::vector<Extent> rows;
    };
    enum class Side : uint8_t { transparent, opaque, mixed };

    void addLevel(const image::AlphaTexture& texture, const image::AlphaTest& test);
    [[nodiscard]] Extent extentOf(const BitmaskAxis& axis, int64_t cell, uint32_t size, double guard) const;
    static Side sideOfTexels(const image::AlphaTexture& texture, uint32_t lowestOpaque, int64_t x0,
                             int64_t x1, int64_t y0, int64_t y1);
    static Side linearSide(const image::AlphaTexture& texture, const image::Threshold& threshold,
                           const Extent& x, const Extent& y);
    static Side exactSide(const image::AlphaTexture& texture, const image::Threshold& threshold,
                          const Extent& x, const Extent& y);
    static Side nearestSide(const image::AlphaTexture& texture, const image::Threshold& threshold,
                            const Extent& x, const Extent& y);

    image::Filter filter_;
    image::Threshold sideThreshold_;
    BitmaskAxis columns_;
    BitmaskAxis rows_;
    std::deque<image::AlphaTexture> coarser_;
    std::vector<Level> levels_;
};

}  // namespace filigree::encoding::bitmask
