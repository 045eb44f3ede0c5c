// What an encoder chooses for a tile: prediction, widths, biases and drops.
#pragma once

#include "filigree/grid/tile.h"

#include "grid/tile_order.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace filigree::grid {

// A vertex of the bit string behind the tile's corners.
struct TileResidual {
    LatticePoint value{};  // each in [-2^23, 2^23), for curve 0
    LatticePoint bend{};   // what a curve of 32 would add to the prediction
    uint8_t x = 0;         // for shearOf
    uint8_t y = 0;
    uint8_t group = 0;  // a ResidualClass, or coarseGroup
    uint8_t block = noBlock;
};
inline constexpr unsigned coarseGroup = residualClasses;

// In the order of the bit string.
struct TileResiduals {
    std::array<TileResidual, Tile::side * Tile::side> list;
    size_t count = 0;

    void add(const TileResidual& residual) { list[count++] = residual; }
    [[nodiscard]] std::span<const TileResidual> all() const { return {list.data(), count}; }
};

// Vertices less their predictions. `head` holds the tile's size.
TileResiduals residualsOf(const Tile& tile, const TileHeader& head);

// A residual on one axis, of a curve.
inline int32_t straightened(const TileResidual& residual, unsigned axis, unsigned curve) {
    return wrappedResidual(residual.value[axis] - curveOf(curve, residual.bend[axis]));
}

// A residual as its fields hold it: less what curve and shear give.
LatticePoint fieldValue(const TileHeader& head, const TileResidual& residual);

// Least width that holds [low, high] with a bias, 25 where none does.
unsigned widthFor(int32_t low, int32_t high, unsigned bias);

// Sets the widths and biases of `head` and the drops of the blocks, given the rest.
void chooseWidths(std::span<const TileResidual> residuals, TileHeader& head,
                  std::array<uint8_t, tileBlocks * tileBlocks>& drops);

// Sets the dominant axis, the curve and the shear.
void choosePrediction(std::span<const TileResidual> residuals, TileHeader& head);

}  // namespace filigree::grid
