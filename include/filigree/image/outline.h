// The outline of a texture: where its filtered alpha crosses a threshold, cell by cell. Costs the image once
// and then lets work follow the outline instead of the area.
//
// Points are in sample space: texel space minus (0.5, 0.5), so that texel (i, j) sits at the point (i, j) and
// cell (i, j) is the square [i, i + 1] x [j, j + 1] between four texels, over which bilinear alpha is one
// patch. Cells are unwrapped: any integer pair is a cell, whatever the wrap mode.
#pragma once

#include "filigree/core/api.h"
#include "filigree/image/alpha_image.h"
#include "filigree/image/patch.h"
#include "filigree/image/threshold.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace filigree::image {

// How unwrapped cells map to the distinct ones on an axis.
struct FILIGREE_API CellAxis {
    uint32_t size = 0;  // texels
    Wrap wrap = Wrap::repeat;
    int64_t cells = 0;  // distinct cells: size (repeat), 2 size (mirrored), size + 1 (clamp)

    CellAxis() = default;
    CellAxis(uint32_t texels, Wrap mode);

    [[nodiscard]] bool clamps() const { return wrap == Wrap::clampToEdge; }

    // The distinct cell that `cell` is a copy of, 0..cells-1.
    [[nodiscard]] int64_t canonical(int64_t cell) const {
        if (clamps()) return cell < -1 ? 0 : cell >= size ? size : cell + 1;
        if (cell >= 0 && cell < cells) return cell;
        const int64_t in = cell % cells;
        return in < 0 ? in + cells : in;
    }
    // An unwrapped cell with that canonical number.
    [[nodiscard]] int64_t representative(int64_t canonicalCell) const {
        return clamps() ? canonicalCell - 1 : canonicalCell;
    }
};

// A piece of the outline in one cell: the true curve from (x0, y0) to (x1, y1), relative to the cell, stays
// within `bulge` of the straight segment. Both ends lie on the outline within 1e-6.
struct OutlinePiece {
    int32_t cell = 0;  // canonical column and row of its cell, see CellAxis
    int32_t row = 0;
    float x0 = 0;
    float y0 = 0;
    float x1 = 0;
    float y1 = 0;
    float bulge = 0;
};

struct ArcPiece;

// Where the opaque part of a texture ends, under one threshold.
class FILIGREE_API Outline {
  public:
    // `filter` must be linear or nearest. The texture must outlive the outline.
    Outline(const AlphaTexture& texture, Filter filter, const Threshold& threshold);

    using Axis = CellAxis;
    [[nodiscard]] const Axis& axisX() const { return axisX_; }
    [[nodiscard]] const Axis& axisY() const { return axisY_; }
    [[nodiscard]] const AlphaTexture& texture() const { return *texture_; }
    [[nodiscard]] Filter filter() const { return filter_; }
    [[nodiscard]] const Threshold& threshold() const { return threshold_; }

    // True when no cell is crossed: the whole plane is one side.
    [[nodiscard]] bool empty() const { return bucketStart_.back() == 0; }

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

    // A block of unwrapped cells, both ends included.
    struct Cells {
        int64_t firstRow = 0;
        int64_t lastRow = 0;
        int64_t firstColumn = 0;
        int64_t lastColumn = 0;
    };

    // A run of pieces and where it lies: piece k of [first, end) is in the unwrapped cell (column + cell, row
    // + row) of its own canonical cell and row.
    struct Run {
        size_t first = 0;
        size_t end = 0;
        int64_t column = 0;
        int64_t row = 0;
    };

    // The last of the rows from `row` on that forEachRun() serves as cheaply as `row` alone: pieces are kept
    // in bands.
    [[nodiscard]] int64_t bandEnd(int64_t row) const {
        if (axisY_.clamps() && (row < -1 || row >= axisY_.size)) return row;
        const int64_t y = axisY_.canonical(row);
        return row + std::min(bandRows - 1 - y % bandRows, axisY_.cells - 1 - y);
    }

    // The last of the rows from `row` on that crosses() serves together: those of its band, or all beyond a
    // clamped border, which are copies of one row.
    [[nodiscard]] int64_t alikeEnd(int64_t row) const {
        if (axisY_.clamps() && row < -1) return -2;
        if (axisY_.clamps() && row >= axisY_.size) return std::numeric_limits<int64_t>::max();
        return bandEnd(row);
    }

    // Calls visit(run) for the pieces in `cells`, whose rows must lie in one band; a run may hold a few
    // neighbours more. Stops early and returns false when visit returns false.
    template <class Visit>
    bool forEachRun(const Cells& cells, Visit&& visit) const;

    // True when any of `cells`, whose rows must lie in one band or all beyond a clamped border, is crossed;
    // may be true for a crossing next to them.
    [[nodiscard]] bool crosses(const Cells& cells) const {
        return !forEachRun(cells, [](const Run&) { return false; });
    }

    // The pieces, each field on its own, with `padding` more entries that hold no piece.
    struct PieceArrays {
        std::vector<int32_t> cell;
        std::vector<int32_t> row;
        std::vector<float> x0;
        std::vector<float> y0;
        std::vector<float> x1;
        std::vector<float> y1;
        std::vector<float> bulge;
    };
    static constexpr size_t padding = 16;
    [[nodiscard]] const PieceArrays& pieceArrays() const { return pieces_; }
    [[nodiscard]] OutlinePiece piece(size_t k) const {
        return {pieces_.cell[k], pieces_.row[k], pieces_.x0[k],   pieces_.y0[k],
                pieces_.x1[k],   pieces_.y1[k],  pieces_.bulge[k]};
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
    static constexpr int64_t bandRows = 4;  // pieces are kept by band of rows,
    static constexpr int64_t bucketCells =
        8;  // in a band by bucket of columns (a byte of bits), in a bucket by row

    void build();
    void buildBand(int64_t firstRow, std::vector<ArcPiece>& scratch);
    void appendCell(size_t column, int64_t row, std::vector<ArcPiece>& scratch);
    [[nodiscard]] const uint16_t* texelRow(int64_t row) const;
    // The side of each texel of an unwrapped row in the order of the canonical cells.
    [[nodiscard]] std::vector<uint64_t> opaqueBits(int64_t row) const;
    // Which cells lie between texels of unlike side, given those of the rows below and above them.
    [[nodiscard]] std::vector<uint64_t> crossedBits(const std::vector<uint64_t>& low,
                                                    const std::vector<uint64_t>& high) const;

    // The pieces of the buckets that hold the canonical cells [first, last] of canonical row `row`'s band.
    [[nodiscard]] Run run(int64_t row, int64_t first, int64_t last) const {
        const uint32_t* buckets = &bucketStart_[static_cast<size_t>(row / bandRows) * rowBuckets_];
        return {buckets[first / bucketCells], buckets[last / bucketCells + 1], 0, 0};
    }
    const AlphaTexture* texture_;
    Filter filter_;
    Threshold threshold_;
    Axis axisX_;
    Axis axisY_;
    std::vector<uint32_t> columns_;  // texel column of each canonical cell's left side, [axisX_.cells + 1]
    size_t rowBuckets_ = 0;
    std::vector<uint32_t> bucketStart_;  // where each bucket's pieces begin, [bands * rowBuckets_ + 1]
    PieceArrays pieces_;
};

template <class Visit>
bool Outline::forEachRun(const Cells& cells, Visit&& visit) const {
    const int64_t y = axisY_.canonical(cells.firstRow);
    const int64_t rowShift = cells.firstRow - y;
    const bool copiedRow = axisY_.clamps() && (cells.firstRow < -1 || cells.firstRow >= axisY_.size);
    // Beyond a clamped border every cell is a copy of the border's, which has to be picked out of its bucket.
    const auto isPicked = [&](size_t k, int64_t first, int64_t last) {
        return pieces_.cell[k] >= first && pieces_.cell[k] <= last && (!copiedRow || pieces_.row[k] == y);
    };
    const auto pick = [&](int64_t first, int64_t last, const Run& from, int64_t columnShift) {
        for (size_t k = from.first; k < from.end; ++k) {
            if (!isPicked(k, first, last)) continue;
            if (!visit(Run{k, k + 1, columnShift, rowShift})) return false;
        }
        return true;
    };
    const auto within = [&](int64_t first, int64_t last, int64_t columnShift) {
        const Run found = run(y, first, last);
        if (found.first == found.end) return true;
        if (copiedRow) return pick(first, last, found, columnShift);
        return visit(Run{found.first, found.end, columnShift, rowShift});
    };
    if (!axisX_.clamps()) {
        for (int64_t x = cells.firstColumn; x <= cells.lastColumn;) {
            const int64_t canonical = axisX_.canonical(x);
            const int64_t count = std::min(cells.lastColumn - x + 1, axisX_.cells - canonical);
            if (!within(canonical, canonical + count - 1, x - canonical)) return false;
            const bool bare = count == axisX_.cells && run(y, 0, count - 1).first == run(y, 0, count - 1).end;
            if (bare) return true;  // A whole period without an outline.
            x += count;
        }
        return true;
    }
    const int64_t border = axisX_.size;
    const auto copies = [&](int64_t first, int64_t last, int64_t column) {
        Run from = run(y, column, column);
        while (from.first < from.end && !isPicked(from.first, column, column)) ++from.first;
        if (from.first == from.end) return true;
        for (int64_t x = first; x <= last; ++x) {
            if (!pick(column, column, from, x - column)) return false;
        }
        return true;
    };
    if (!copies(cells.firstColumn, std::min<int64_t>(cells.lastColumn, -2), 0)) return false;
    const int64_t first = std::max<int64_t>(cells.firstColumn, -1);
    const int64_t last = std::min(cells.lastColumn, border - 1);
    if (first <= last && !within(first + 1, last + 1, -1)) return false;
    return copies(std::max(cells.firstColumn, border), cells.lastColumn, axisX_.cells - 1);
}

}  // namespace filigree::image
