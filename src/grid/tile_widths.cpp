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

// Widths and drops of what lies inside the blocks.
class InsideWidths {
  public:
    InsideWidths(const Extents& extents, const TileHeader& head) : blocks_(head.blocks()) {
        for (unsigned block = 0; block < blocks_; ++block) {
            counts_[block] = insideCounts(head.columnsOf(block % head.blockColumns()),
                                          head.rowsOf(block / head.blockColumns()));
            for (unsigned c = insideCentre; c < residualClasses; ++c)
                for (unsigned k = 0; k < 3; ++k)
                    needed_[block][c][k] =
                        extents[c][block][k].width(k == head.dominant ? head.bias[c] : evenBias);
        }
    }

    // The code of how far the widths inside a block may fall.
    [[nodiscard]] uint8_t drop(const TileHeader& head, unsigned block) const {
        unsigned least = 3;
        for (unsigned c = insideCentre; c < residualClasses; ++c)
            for (unsigned k = 0; k < 3; ++k)
                if (const unsigned needed = needed_[block][c][k]; needed != 0)
                    least = std::min({least, head.width[k][c] - needed, 2U});
        return static_cast<uint8_t>(least);
    }
    [[nodiscard]] uint32_t bits(const TileHeader& head) const {
        std::array<std::array<unsigned, 3>, 4> vertex{};  // [drop code][class]
        for (uint8_t code = 0; code < 4; ++code)
            for (unsigned c = 0; c < 3; ++c)
                vertex[code][c] =
                    vertexBits(head, static_cast<ResidualClass>(insideCentre + c), dropOf(code));
        uint32_t bits = 0;
        for (unsigned block = 0; block < blocks_; ++block) {
            const auto& each = vertex[drop(head, block)];
            const InsideCounts& count = counts_[block];
            bits += count.centres * each[0] + count.crosses * each[1] + count.diagonals * each[2];
        }
        return bits;
    }
    // Widens a class where that lets blocks drop further.
    void widen(TileHeader& head) const {
        uint32_t least = bits(head);
        for (unsigned c = insideCentre; c < residualClasses; ++c)
            for (auto& widths : head.width) {
                if (widths[c] == 0 || widths[c] == widestField) continue;
                ++widths[c];
                if (const uint32_t tried = bits(head); tried < least)
                    least = tried;
                else
                    --widths[c];
            }
    }

  private:
    unsigned blocks_;
    std::array<InsideCounts, noBlock> counts_{};
    // [block][class][axis]
    std::array<std::array<std::array<unsigned, 3>, residualClasses>, noBlock> needed_{};
};

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

void chooseWidths(std::span<const TileResidual> residuals, TileHeader& head,
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
    const InsideWidths inside(extents, head);
    inside.widen(head);
    for (unsigned block = 0; block < head.blocks(); ++block) drops[block] = inside.drop(head, block);
}

}  // namespace filigree::grid
