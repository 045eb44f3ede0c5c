#include "grid/tile_plan.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace filigree::grid {
namespace {

// Lowest and highest value of a set.
struct Extent {
    int32_t low = std::numeric_limits<int32_t>::max();
    int32_t high = std::numeric_limits<int32_t>::min();

    [[nodiscard]] bool empty() const { return low > high; }
    void extend(int32_t value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    void extend(const Extent& other) {
        low = std::min(low, other.low);
        high = std::max(high, other.high);
    }
    [[nodiscard]] unsigned width(unsigned bias) const { return empty() ? 0 : widthFor(low, high, bias); }
};

// [group][block][axis], with noBlock behind the blocks.
using Extents = std::array<std::array<std::array<Extent, 3>, noBlock + 1>, residualClasses + 1>;

Extents extentsOf(std::span<const TileResidual> residuals, const TileHeader& head) {
    Extents extents;
    for (const TileResidual& residual : residuals) {
        const LatticePoint value = fieldValue(head, residual);
        for (unsigned k = 0; k < 3; ++k) extents[residual.group][residual.block][k].extend(value[k]);
    }
    return extents;
}

Extent extentOverBlocks(const Extents& extents, unsigned group, unsigned axis) {
    Extent all;
    for (const auto& block : extents[group]) all.extend(block[axis]);
    return all;
}

// The bias of least width; of those the one with which single blocks need least.
unsigned bestBias(const Extents& extents, unsigned group, unsigned axis) {
    const Extent all = extentOverBlocks(extents, group, axis);
    unsigned best = evenBias;
    unsigned width = all.width(evenBias);
    unsigned least = std::numeric_limits<unsigned>::max();
    for (const unsigned bias : {4U, 3U, 5U, 2U, 6U, 1U, 7U, 0U}) {
        const unsigned needed = all.width(bias);
        if (needed > width) continue;
        unsigned sum = 0;
        for (const auto& block : extents[group]) sum += block[axis].width(bias);
        if (needed == width && sum >= least) continue;
        best = bias;
        width = needed;
        least = sum;
    }
    return best;
}

// The code of how far the widths inside a block may fall.
uint8_t dropFor(const Extents& extents, const TileHeader& head, unsigned block) {
    unsigned least = 3;
    for (const unsigned c : {insideCentre, insideCross, insideDiagonal})
        for (unsigned k = 0; k < 3; ++k) {
            const unsigned needed = extents[c][block][k].width(k == head.dominant ? head.bias[c] : evenBias);
            if (needed != 0) least = std::min({least, head.width[k][c] - needed, 2U});
        }
    return static_cast<uint8_t>(least);
}

TileFrame tileFrameOf(const Tile& tile, const TileHeader& head) {
    TileFrame frame;
    for (unsigned row = 0; row <= head.rows; ++row)
        for (unsigned column = 0; column <= head.columns; ++column)
            frame.fineAt(framePlace(head.columns, column), framePlace(head.rows, row)) = tile.at(column, row);
    for (unsigned j = 0; j <= head.blockRows(); ++j)
        for (unsigned i = 0; i <= head.blockColumns(); ++i)
            frame.coarseAt(placesOfSteps[head.blockColumns()][i], placesOfSteps[head.blockRows()][j]) =
                frame.fineAt(4 * i, 4 * j);
    return frame;
}

LatticePoint residualFrom(const LatticePoint& point, const LatticePoint& prediction) {
    LatticePoint residual{};
    for (unsigned k = 0; k < 3; ++k) residual[k] = wrappedResidual(point[k] - prediction[k]);
    return residual;
}

}  // namespace

unsigned widthFor(int32_t low, int32_t high, unsigned bias) {
    const uint32_t reach = static_cast<uint32_t>(std::max(high, -low));
    unsigned width = reach == 0 ? 0 : static_cast<unsigned>(std::bit_width(reach));
    while (width <= widestField) {
        const int32_t offset = biasOf(bias, width);
        if (low >= -offset && high < (1 << width) - offset) break;
        ++width;
    }
    return width;
}

TileResiduals residualsOf(const Tile& tile, const TileHeader& head) {
    TileFrame frame = tileFrameOf(tile, head), less, bends;
    TileHeader straight = head;
    straight.curve = 0;
    Patch coarse = frame.coarsePatch(head);
    coarse.walk([&](unsigned px, unsigned py, ResidualClass, const LatticePoint& prediction) {
        less.coarseAt(px, py) = residualFrom(coarse.at(px, py), prediction);
    });
    for (unsigned j = 0; j < head.blockRows(); ++j)
        for (unsigned i = 0; i < head.blockColumns(); ++i) {
            Patch patch = frame.blockPatch(straight, i, j);
            patch.walk([&](unsigned px, unsigned py, ResidualClass c, const LatticePoint& prediction) {
                less.fineAt(4 * i + px, 4 * j + py) = residualFrom(patch.at(px, py), prediction);
                if (c == edgeQuarter || c == insideCross)
                    bends.fineAt(4 * i + px, 4 * j + py) = patch.bendAt(px, py);
            });
        }

    TileResiduals residuals;
    const auto narrow = [](unsigned value) { return static_cast<uint8_t>(value); };
    walkCoarse(head, [&](unsigned px, unsigned py) {
        residuals.add({less.coarseAt(px, py), {}, narrow(4 * px), narrow(4 * py), coarseGroup, noBlock});
    });
    walkFine(head, [&](ResidualClass c, unsigned x, unsigned y, unsigned block) {
        residuals.add(
            {less.fineAt(x, y), bends.fineAt(x, y), narrow(x), narrow(y), narrow(c), narrow(block)});
    });
    return residuals;
}

LatticePoint fieldValue(const TileHeader& head, const TileResidual& residual) {
    LatticePoint value{};
    for (unsigned k = 0; k < 3; ++k) value[k] = straightened(residual, k, head.curve);
    const int32_t main = value[head.dominant];
    const auto minors = minorAxes(head.dominant);
    for (unsigned m = 0; m < 2; ++m)
        value[minors[m]] = wrappedResidual(
            wrappedDifference(value[minors[m]], shearOf(head, m, residual.x, residual.y, main)));
    return value;
}

uint32_t chooseWidths(std::span<const TileResidual> residuals, TileHeader& head,
                      std::array<uint8_t, tileBlocks * tileBlocks>& drops) {
    const Extents extents = extentsOf(residuals, head);
    for (unsigned k = 0; k < 3; ++k)
        head.coarseWidth[k] = extentOverBlocks(extents, coarseGroup, k).width(evenBias);
    for (unsigned c = 0; c < residualClasses; ++c) {
        head.bias[c] = bestBias(extents, c, head.dominant);
        for (unsigned k = 0; k < 3; ++k)
            head.width[k][c] =
                extentOverBlocks(extents, c, k).width(k == head.dominant ? head.bias[c] : evenBias);
    }
    uint32_t bits = tileParts(head).insides;
    for (unsigned j = 0; j < head.blockRows(); ++j)
        for (unsigned i = 0; i < head.blockColumns(); ++i) {
            const unsigned block = j * head.blockColumns() + i;
            drops[block] = dropFor(extents, head, block);
            bits += insideBits(head, i, j, dropOf(drops[block]));
        }
    return bits;
}

}  // namespace filigree::grid
