// Tiles of all sorts for tests of the lattice codec.
#pragma once

#include "filigree/grid/tile.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <random>

namespace filigree::grid {

enum class TileSort {
    flat,     // a regular sheet
    height,   // a heightfield: x and z regular
    smooth,   // a curved sheet across all axes
    rough,    // the same with noise
    patchy,   // level ground beside rough ground
    noise,    // any coordinates
    extreme,  // the lattice's ends
};
inline constexpr std::array everyTileSort{TileSort::flat,   TileSort::height, TileSort::smooth,
                                          TileSort::rough,  TileSort::patchy, TileSort::noise,
                                          TileSort::extreme};

inline LatticePoint someTilePoint(TileSort sort, unsigned column, unsigned row, std::mt19937& random) {
    const auto below = [&](uint32_t limit) { return static_cast<int32_t>(random() % limit); };
    const double u = column / 16.0, v = row / 16.0;
    const auto wave = [&](double a, double b) {
        return static_cast<int32_t>(4000000 + 20000 * std::sin(a * u + b * v));
    };
    const auto x = static_cast<int32_t>(column), z = static_cast<int32_t>(row);
    switch (sort) {
        case TileSort::flat:
            return {1000 + x, 77, 20 + z};
        case TileSort::height:
            return {1000 + x, wave(1.7, 2.3) + below(30), 20 + z};
        case TileSort::smooth:
            return {wave(2, 0.1) + 9 * x, wave(1.5, 1), wave(0.3, 1) + 7 * z};
        case TileSort::rough:
            return {wave(2, 0.1) + below(300), wave(1.5, 1) + below(500), wave(0.3, 1) + below(40)};
        case TileSort::patchy:
            return {1000 + x, column / 8 == row / 8 ? 700 + below(500) : 700, 20 + z};
        case TileSort::noise:
            return {below(latticeLimit), below(latticeLimit), below(latticeLimit)};
        case TileSort::extreme:
            break;
    }
    const auto end = [&] { return below(2) * (latticeLimit - 1); };
    return {end(), end(), end()};
}

inline Tile someTile(TileSort sort, unsigned columns, unsigned rows, uint32_t seed) {
    std::mt19937 random(seed);
    Tile tile;
    tile.place = {static_cast<uint32_t>(random() & 0xffffff), static_cast<uint32_t>(random() & 0xfff) * 16,
                  static_cast<uint32_t>(random() & 0xfff) * 16, columns, rows};
    for (unsigned row = 0; row <= rows; ++row)
        for (unsigned column = 0; column <= columns; ++column)
            tile.at(column, row) = someTilePoint(sort, column, row, random);
    const bool mixed = random() % 2 != 0;
    for (unsigned row = 0; row < rows; ++row)
        for (unsigned column = 0; column < columns; ++column)
            tile.bd.set(row * 16 + column, mixed && random() % 2 != 0);
    return tile;
}

}  // namespace filigree::grid
