// The outline of a texture: where its filtered alpha crosses a threshold, cell by cell. Costs the image once
// and then lets work follow the outline instead of the area.
//
// Points are in sample space: texel space minus (0.5, 0.5), so that texel (i, j) sits at the point (i, j) and
// cell (i, j) is the square [i, i + 1] x [j, j + 1] between four texels, over which bilinear alpha is one
// patch. Cells are unwrapped: any integer pair is a cell, whatever the wrap mode.
#pragma once

#include "filigree/image/alpha_image.h"
#include "filigree/image/patch.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
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
std::vector<Threshold> thresholdsOf(const AlphaTest& test, double vertexAlpha, uint32_t steps);

// The threshold that tells the greater side of an unknown micro-triangle: the mask's own; alpha 0.5 for
// blend.
Threshold sideThreshold(const AlphaTest& test, double vertexAlpha, uint32_t steps);

// A piece of the outline in one cell: the true curve from (x0, y0) to (x1, y1), relative to the cell, stays
// within `bulge` of the straight segment. Both ends lie on the outline within 1e-6.
struct OutlinePiece {
    int32_t cell = 0;  // canonical cell on its row, see Outline::Axis
    float x0 = 0;
    float y0 = 0;
    float x1 = 0;
    float y1 = 0;
    float bulge = 0;
};

class Outline {
  public:
    // `filter` must be linear or nearest. The texture must outlive the outline.
    Outline(const AlphaTexture& texture, Filter filter, const Threshold& threshold);

    // How unwrapped cells map to the distinct ones on an axis.
    struct Axis {
        uint32_t size = 0;  // texels
        Wrap wrap = Wrap::repeat;
        int64_t cells = 0;  // distinct cells: size (repeat), 2 size (mirrored), size + 1 (clamp)

        Axis() = default;
        Axis(uint32_t texels, Wrap mode);

        // The distinct cell that `cell` is a copy of, 0..cells-1.
        [[nodiscard]] int64_t canonical(int64_t cell) const {
            if (wrap == Wrap::clampToEdge) return cell < -1 ? 0 : cell >= size ? size : cell + 1;
            const int64_t in = cell % cells;
            return in < 0 ? in + cells : in;
        }
        // An unwrapped cell with that canonical number.
        [[nodiscard]] int64_t representative(int64_t canonicalCell) const {
            return wrap == Wrap::clampToEdge ? canonicalCell - 1 : canonicalCell;
        }
    };

    [[nodiscard]] const Axis& axisX() const { return axisX_; }
    [[nodiscard]] const Axis& axisY() const { return axisY_; }
    [[nodiscard]] const AlphaTexture& texture() const { return *texture_; }
    [[nodiscard]] Filter filter() const { return filter_; }
    [[nodiscard]] const Threshold& threshold() const { return threshold_; }

    // True when no cell is crossed: the whole plane is one side.
    [[nodiscard]] bool empty() const { return pieces_.empty(); }

    // The texel at unwrapped integer coordinates.
    [[nodiscard]] uint16_t texel(int64_t x, int64_t y) const {
        return texture_->image.at(wrapTexel(x, axisX_.size, axisX_.wrap),
                                  wrapTexel(y, axisY_.size, axisY_.wrap));
    }
    [[nodiscard]] bool texelIsOpaque(int64_t x, int64_t y) const {
        return texel(x, y) >= threshold_.lowestOpaque;
    }

    // The bilinear patch of an unwrapped cell, minus the threshold.
    [[nodiscard]] Patch patch(int64_t x, int64_t y) const {
        return Patch::of(texel(x, y), texel(x + 1, y), texel(x, y + 1), texel(x + 1, y + 1),
                         threshold_.value);
    }

    // Calls visit(offset, pieces) for the pieces in the unwrapped cells [first, last] of row `row`; a piece
    // lies in cell offset + piece.cell. Stops early and returns false when visit returns false.
    template <class Visit>
    bool forEachPiece(int64_t row, int64_t first, int64_t last, Visit&& visit) const;

    // True when any of the unwrapped cells [first, last] of row `row` is crossed.
    [[nodiscard]] bool crosses(int64_t row, int64_t first, int64_t last) const {
        return !forEachPiece(row, first, last, [](int64_t, std::span<const OutlinePiece>) { return false; });
    }

    // The halves of a piece of a cell with that patch, or none where it cannot be split with certainty.
    [[nodiscard]] std::optional<std::array<OutlinePiece, 2>> split(const OutlinePiece& piece,
                                                                   const Patch& patch) const;

    // The side of a point, and how far its alpha is from the threshold, in alpha (1 where the whole cell is
    // one side).
    struct Side {
        bool opaque = false;
        double distance = 0;
    };
    [[nodiscard]] Side sideAt(double x, double y) const;

    [[nodiscard]] size_t memoryBytes() const;

  private:
    static constexpr int64_t bucketCells = 8;

    void build();
    void buildRow(int64_t y, const std::vector<uint64_t>& low, const std::vector<uint64_t>& high);
    void appendPieces(const std::array<uint16_t, 4>& corners, int32_t cell);
    [[nodiscard]] const uint16_t* texelRow(int64_t row) const;
    // The side of each texel of an unwrapped row in the order of the canonical cells.
    [[nodiscard]] std::vector<uint64_t> opaqueBits(int64_t row) const;

    // The pieces of canonical cells [first, last] of canonical row `row`.
    [[nodiscard]] std::span<const OutlinePiece> pieces(int64_t row, int64_t first, int64_t last) const {
        const uint32_t* buckets = &bucketStart_[static_cast<size_t>(row) * rowBuckets_];
        const OutlinePiece* from = pieces_.data() + buckets[first / bucketCells];
        const OutlinePiece* to = pieces_.data() + buckets[last / bucketCells + 1];
        while (from < to && from->cell < first) ++from;
        while (from < to && to[-1].cell > last) --to;
        return {from, to};
    }

    const AlphaTexture* texture_;
    Filter filter_;
    Threshold threshold_;
    Axis axisX_;
    Axis axisY_;
    std::vector<uint32_t> columns_;  // texel column of each canonical cell's left side, [axisX_.cells + 1]
    size_t rowBuckets_ = 0;
    std::vector<uint32_t>
        bucketStart_;  // where the pieces of each 8 cells begin, [axisY_.cells * rowBuckets_ + 1]
    std::vector<OutlinePiece> pieces_;  // by row, then cell
};

template <class Visit>
bool Outline::forEachPiece(int64_t row, int64_t first, int64_t last, Visit&& visit) const {
    const int64_t y = axisY_.canonical(row);
    if (axisX_.wrap == Wrap::clampToEdge) {
        // Cells beyond the border copy the border's, one by one.
        const auto copies = [&](int64_t from, int64_t to, int64_t canonical) {
            const auto copied =
                from <= to ? pieces(y, canonical, canonical) : std::span<const OutlinePiece>{};
            if (copied.empty()) return true;
            for (int64_t x = from; x <= to; ++x) {
                if (!visit(x - canonical, copied)) return false;
            }
            return true;
        };
        const int64_t low = -1;
        const int64_t high = axisX_.size - 1;
        if (!copies(first, std::min(last, low - 1), 0)) return false;
        const int64_t from = std::max(first, low);
        const int64_t to = std::min(last, high);
        if (from <= to) {
            const auto found = pieces(y, from + 1, to + 1);
            if (!found.empty() && !visit(int64_t{-1}, found)) return false;
        }
        return copies(std::max(first, high + 1), last, axisX_.cells - 1);
    }
    for (int64_t x = first; x <= last;) {
        const int64_t canonical = axisX_.canonical(x);
        const int64_t count = std::min(last - x + 1, axisX_.cells - canonical);
        const auto found = pieces(y, canonical, canonical + count - 1);
        if (!found.empty()) {
            if (!visit(x - canonical, found)) return false;
        } else if (count == axisX_.cells) {
            return true;  // A whole period without an outline.
        }
        x += count;
    }
    return true;
}

}  // namespace filigree::image
