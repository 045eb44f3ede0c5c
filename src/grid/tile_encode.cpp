#include "filigree/core/bits.h"
#include "filigree/grid/tile.h"

#include "grid/tile_boxes.h"
#include "grid/tile_plan.h"

#include <algorithm>
#include <cassert>

namespace filigree::grid {
namespace {

using BlockBytes = std::array<uint8_t, tileBlocks * tileBlocks>;

// The least reach whose unit is not below `unit`.
unsigned reachFor(uint32_t unit) {
    unsigned shift = 0;
    while ((uint64_t{7} << shift) < unit) ++shift;
    return shift << 3 | ((unit + (1U << shift) - 1) >> shift);
}

// How far a block's vertices reach below and above its corners.
struct Reach {
    LatticePoint low{};
    LatticePoint high{};
};
Reach blockReachOf(const Tile& tile, const TileHeader& head, unsigned i, unsigned j) {
    const LatticeBox corners = cornerBox(tile, head, i, j), all = vertexBox(tile, head, i, j);
    Reach reach;
    for (unsigned k = 0; k < 3; ++k) {
        reach.low[k] = corners.low[k] - all.low[k];
        reach.high[k] = all.high[k] - corners.high[k];
    }
    return reach;
}

// Sets the units of `head` and the upper bits of `blocks`.
class ReachChoice {
  public:
    ReachChoice(const Tile& tile, TileHeader& head, BlockBytes& blocks) : head_(head), blocks_(blocks) {
        for (unsigned j = 0; j < head.blockRows(); ++j)
            for (unsigned i = 0; i < head.blockColumns(); ++i)
                reaches_[j * head.blockColumns() + i] = blockReachOf(tile, head, i, j);
    }

    void choose() {
        const unsigned main = head_.dominant;
        int32_t most = 0;
        for (const Reach& reach : reaches_) most = std::max({most, reach.low[main], reach.high[main]});
        head_.reach[main] = reachFor((static_cast<uint32_t>(most) + 6) / 7);
        std::array<uint32_t, 3> unit{};
        for (unsigned block = 0; block < head_.blocks(); ++block) {
            const Reach& reach = reaches_[block];
            const unsigned low = steps(reach.low[main]);
            const unsigned high =
                std::max(steps(reach.high[main]), low == 0 && reachesAside(reach) ? 1U : 0U);
            blocks_[block] = static_cast<uint8_t>(blocks_[block] | low << 2 | high << 5);
            for (const unsigned k : minorAxes(main)) {
                const auto aside = static_cast<uint32_t>(std::max(reach.low[k], reach.high[k]));
                if (aside != 0)
                    unit[k] = std::max(unit[k], (aside + std::max(low, high) - 1) / std::max(low, high));
            }
        }
        for (const unsigned k : minorAxes(main)) head_.reach[k] = reachFor(unit[k]);
    }

  private:
    [[nodiscard]] unsigned steps(int32_t reach) const {
        const uint32_t unit = reachUnit(head_.reach[head_.dominant]);
        return unit == 0 ? 0 : (static_cast<uint32_t>(reach) + unit - 1) / unit;
    }
    [[nodiscard]] bool reachesAside(const Reach& reach) const {
        const auto minors = minorAxes(head_.dominant);
        return std::any_of(minors.begin(), minors.end(),
                           [&](unsigned k) { return reach.low[k] > 0 || reach.high[k] > 0; });
    }

    TileHeader& head_;
    BlockBytes& blocks_;
    std::array<Reach, tileBlocks * tileBlocks> reaches_{};
};

using CornerDeltas = std::array<LatticePoint, 3>;
CornerDeltas cornerDeltas(const Tile& tile) {
    const unsigned right = tile.place.columns, bottom = tile.place.rows;
    CornerDeltas deltas;
    for (unsigned k = 0; k < 3; ++k) {
        const int32_t base = tile.at(0, 0)[k];
        const int32_t across = tile.at(right, 0)[k], down = tile.at(0, bottom)[k];
        deltas[0][k] = wrappedResidual(across - base);
        deltas[1][k] = wrappedResidual(down - base);
        deltas[2][k] = wrappedResidual(tile.at(right, bottom)[k] - (across + down - base));
    }
    return deltas;
}

void setCornerWidths(const CornerDeltas& deltas, TileHeader& head) {
    for (unsigned k = 0; k < 3; ++k) {
        const auto [low, high] = std::minmax({deltas[0][k], deltas[1][k], deltas[2][k]});
        head.cornerWidth[k] = widthFor(low, high, evenBias);
    }
}

TileDiagonals tileDiagonalsOf(const Tile& tile) {
    const size_t bd = tile.bd.count();
    if (bd == 0) return TileDiagonals::allAc;
    return bd == size_t{tile.place.columns} * tile.place.rows ? TileDiagonals::allBd : TileDiagonals::mixed;
}

TileHeader tileHeaderOf(const Tile& tile) {
    const TilePlace& place = tile.place;
    assert(place.grid < 1U << 24 && place.column % tileQuads == 0 && place.row % tileQuads == 0);
    TileHeader head;
    head.grid = place.grid;
    head.columns = place.columns;
    head.rows = place.rows;
    head.tileColumn = place.column / tileQuads;
    head.tileRow = place.row / tileQuads;
    head.diagonals = tileDiagonalsOf(tile);
    for (unsigned k = 0; k < 3; ++k) {
        assert(tile.at(0, 0)[k] >= 0 && tile.at(0, 0)[k] < latticeLimit);
        head.base[k] = static_cast<uint32_t>(tile.at(0, 0)[k]);
    }
    return head;
}

class BitString {
  public:
    void put(const LatticePoint& value, const std::array<unsigned, 3>& width,
             const std::array<unsigned, 3>& bias) {
        for (unsigned k = 0; k < 3; ++k) {
            const int32_t field = value[k] + biasOf(bias[k], width[k]);
            assert(field >= 0 && field < 1 << width[k]);
            bits_.append(static_cast<uint64_t>(field), width[k]);
        }
    }
    // To a whole number of records' units, `before` bytes having been written.
    void appendTo(std::vector<uint8_t>& bytes, size_t before) const {
        size_t left = (bits_.size() + 7) / 8;
        left += (8 - (before + left) % 8) % 8;
        for (size_t at = 0; left > 0; ++at)
            for (unsigned k = 0; k < 8 && left > 0; ++k, --left)
                bytes.push_back(at < bits_.words().size() ? static_cast<uint8_t>(bits_.words()[at] >> 8 * k)
                                                          : 0);
    }

  private:
    BitWriter bits_;
};

void putDiagonals(const Tile& tile, const TileHeader& head, std::vector<uint8_t>& records) {
    if (head.diagonals != TileDiagonals::mixed) return;
    std::array<uint16_t, tileBlocks * tileBlocks> masks{};
    for (unsigned row = 0; row < head.rows; ++row)
        for (unsigned column = 0; column < head.columns; ++column)
            if (tile.bd.test(row * tileQuads + column)) {
                uint16_t& mask = masks[row / 4 * head.blockColumns() + column / 4];
                mask = static_cast<uint16_t>(mask | 1U << (row % 4 * 4 + column % 4));
            }
    for (unsigned block = 0; block < head.blocks(); ++block) {
        records.push_back(static_cast<uint8_t>(masks[block]));
        records.push_back(static_cast<uint8_t>(masks[block] >> 8));
    }
}

}  // namespace

void encodeTile(const Tile& tile, std::vector<uint8_t>& records) {
    TileHeader head = tileHeaderOf(tile);
    const CornerDeltas corners = cornerDeltas(tile);
    setCornerWidths(corners, head);
    const TileResiduals residuals = residualsOf(tile, head);
    choosePrediction(residuals.all(), head);
    BlockBytes blocks{};
    chooseWidths(residuals.all(), head, blocks);
    ReachChoice(tile, head, blocks).choose();

    constexpr std::array<unsigned, 3> even{evenBias, evenBias, evenBias};
    BitString bits;
    for (const LatticePoint& corner : corners) bits.put(corner, head.cornerWidth, even);
    for (const TileResidual& residual : residuals.all()) {
        const bool inside = residual.block != noBlock;
        const FieldWidths fields = residual.group == coarseGroup
                                       ? FieldWidths{head.coarseWidth}
                                       : fineFields(head, static_cast<ResidualClass>(residual.group),
                                                    inside ? dropOf(blocks[residual.block]) : 0);
        std::array<unsigned, 3> bias = even;
        bias[head.dominant] = fields.dominantBias;
        bits.put(fieldValue(head, residual), fields.width, bias);
    }

    const size_t begin = records.size();
    records.resize(begin + tileHeaderBytes);
    storeTileHeader(records.data() + begin, head);
    records.insert(records.end(), blocks.begin(), blocks.begin() + head.blocks());
    putDiagonals(tile, head, records);
    bits.appendTo(records, records.size() - begin);
}

}  // namespace filigree::grid
