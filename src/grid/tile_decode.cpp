#include "filigree/grid/tile.h"

#include "grid/tile_order.h"

namespace filigree::grid {
namespace {

// Fields one after the other.
class FieldReader {
  public:
    explicit FieldReader(const uint8_t* from) : from_(from) {}

    int32_t take(unsigned width) {
        uint32_t field = 0;
        for (unsigned k = 0; k < width; k += 8) {
            const unsigned count = std::min(8U, width - k);
            field |= takeByte(count) << k;
        }
        return static_cast<int32_t>(field);
    }
    [[nodiscard]] uint32_t position() const { return at_; }

  private:
    uint32_t takeByte(unsigned count) {
        const unsigned shift = at_ % 8;
        uint32_t bits = from_[at_ / 8];
        if (shift + count > 8) bits |= uint32_t{from_[at_ / 8 + 1]} << 8;
        at_ += count;
        return bits >> shift & ((1U << count) - 1);
    }

    const uint8_t* from_;
    uint32_t at_ = 0;
};

class TileDecoder {
  public:
    explicit TileDecoder(const uint8_t* record)
        : record_(record), head_(loadTileHeader(record)), fields_(record + tileParts(head_).bits) {}

    Tile decode() {
        readCorners();
        readCoarse();
        readFine();
        Tile tile = tileFrom();
        readDiagonals(tile);
        return tile;
    }

  private:
    LatticePoint takeEven(const std::array<unsigned, 3>& width) {
        LatticePoint value{};
        for (unsigned k = 0; k < 3; ++k) value[k] = fields_.take(width[k]) - biasOf(evenBias, width[k]);
        return value;
    }
    LatticePoint takeResidual(const FieldWidths& of, unsigned x, unsigned y) {
        LatticePoint residual{};
        for (unsigned k = 0; k < 3; ++k) {
            const unsigned bias = k == head_.dominant ? of.dominantBias : evenBias;
            residual[k] = fields_.take(of.width[k]) - biasOf(bias, of.width[k]);
        }
        const int32_t main = residual[head_.dominant];
        const auto minors = minorAxes(head_.dominant);
        for (unsigned m = 0; m < 2; ++m)
            residual[minors[m]] = wrappedSum(residual[minors[m]], shearOf(head_, m, x, y, main));
        return residual;
    }
    static LatticePoint sum(const LatticePoint& p, const LatticePoint& residual) {
        LatticePoint point{};
        for (unsigned k = 0; k < 3; ++k) point[k] = wrappedPoint(wrappedSum(p[k], residual[k]));
        return point;
    }

    void readCorners() {
        LatticePoint base{};
        for (unsigned k = 0; k < 3; ++k) base[k] = static_cast<int32_t>(head_.base[k]);
        const LatticePoint right = sum(base, takeEven(head_.cornerWidth));
        const LatticePoint below = sum(base, takeEven(head_.cornerWidth));
        LatticePoint across{};
        for (unsigned k = 0; k < 3; ++k) across[k] = right[k] + below[k] - base[k];
        frame_.coarseAt(0, 0) = base;
        frame_.coarseAt(4, 0) = right;
        frame_.coarseAt(0, 4) = below;
        frame_.coarseAt(4, 4) = sum(across, takeEven(head_.cornerWidth));
    }
    void readCoarse() {
        TileFrame residuals;
        const FieldWidths widths{head_.coarseWidth};
        walkCoarse(head_, [&](unsigned px, unsigned py) {
            residuals.coarseAt(px, py) = takeResidual(widths, 4 * px, 4 * py);
        });
        Patch patch = frame_.coarsePatch(head_);
        patch.walk([&](unsigned px, unsigned py, ResidualClass, const LatticePoint& prediction) {
            patch.at(px, py) = sum(prediction, residuals.coarseAt(px, py));
        });
        for (unsigned j = 0; j <= head_.blockRows(); ++j)
            for (unsigned i = 0; i <= head_.blockColumns(); ++i)
                frame_.fineAt(4 * i, 4 * j) = frame_.coarseAt(placesOfSteps[head_.blockColumns()][i],
                                                              placesOfSteps[head_.blockRows()][j]);
    }
    void readFine() {
        TileFrame residuals;
        walkFine(head_, [&](ResidualClass c, unsigned x, unsigned y, unsigned block) {
            const unsigned drop = block == noBlock ? 0 : dropOf(record_[tileHeaderBytes + block]);
            residuals.fineAt(x, y) = takeResidual(fineFields(head_, c, drop), x, y);
        });
        for (unsigned j = 0; j < head_.blockRows(); ++j)
            for (unsigned i = 0; i < head_.blockColumns(); ++i) {
                Patch patch = frame_.blockPatch(head_, i, j);
                patch.walk([&](unsigned px, unsigned py, ResidualClass, const LatticePoint& prediction) {
                    patch.at(px, py) = sum(prediction, residuals.fineAt(4 * i + px, 4 * j + py));
                });
            }
    }
    Tile tileFrom() {
        Tile tile;
        tile.place = tilePlace(record_);
        for (unsigned row = 0; row <= head_.rows; ++row)
            for (unsigned column = 0; column <= head_.columns; ++column)
                tile.at(column, row) =
                    frame_.fineAt(framePlace(head_.columns, column), framePlace(head_.rows, row));
        return tile;
    }
    void readDiagonals(Tile& tile) const {
        const uint8_t* bits = record_ + tileParts(head_).diagonals;
        for (unsigned row = 0; row < head_.rows; ++row)
            for (unsigned column = 0; column < head_.columns; ++column) {
                const unsigned block = row / 4 * head_.blockColumns() + column / 4;
                const bool bd =
                    head_.diagonals == TileDiagonals::mixed
                        ? (loadLe<uint16_t>(bits + 2 * block) >> (row % 4 * 4 + column % 4) & 1) != 0
                        : head_.diagonals == TileDiagonals::allBd;
                tile.bd.set(row * tileQuads + column, bd);
            }
    }

    const uint8_t* record_;
    TileHeader head_;
    FieldReader fields_;
    TileFrame frame_;
};

}  // namespace

TilePlace tilePlace(const uint8_t* record) {
    const TileHeader head = loadTileHeader(record);
    return {head.grid, tileQuads * head.tileColumn, tileQuads * head.tileRow, head.columns, head.rows};
}

size_t tileBytes(const uint8_t* record) {
    const TileHeader head = loadTileHeader(record);
    const size_t bytes = tileParts(head).bits + (size_t{bitStringSize(record, head)} + 7) / 8;
    return (bytes + 7) / 8 * 8;
}

Tile decodeTile(const uint8_t* record) {
    return TileDecoder(record).decode();
}

}  // namespace filigree::grid
