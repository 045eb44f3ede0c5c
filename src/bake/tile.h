// A part of a triangle that is small enough to classify in one go: a sub-triangle of the subdivision with up
// to 4^6 micro-triangles, one bit each in two planes.
#pragma once

#include "filigree/core/bits.h"
#include "filigree/micromap/curve.h"
#include "filigree/micromap/state.h"

#include "bake/placement.h"

#include <array>
#include <cstdint>
#include <vector>

namespace filigree::bake {

inline constexpr unsigned tileLevel = 6;

// A sub-triangle and the lattice of micro-triangles on it. Its corners are lattice points of the whole
// triangle at the finest level, in the order that the curve needs.
struct SubTriangle {
    unsigned level = 0;   // of the whole triangle: the finest lattice has 2^level steps
    unsigned height = 0;  // levels left: 4^height micro-triangles lie in the sub-triangle
    std::array<micromap::LatticePoint, 3> corner{};

    static SubTriangle whole(unsigned level) {
        const uint32_t n = 1u << level;
        return {level, level, {{{0, 0}, {n, 0}, {0, n}}}};
    }
    [[nodiscard]] SubTriangle child(unsigned k) const {
        const auto midpoint = [](micromap::LatticePoint a, micromap::LatticePoint b) {
            return micromap::LatticePoint{(a.i + b.i) / 2, (a.j + b.j) / 2};
        };
        return {level, height - 1, micromap::childCorners(corner, k, midpoint)};
    }

    // The lattice point of the whole triangle at the sub-triangle's own lattice point (i, j), 0 <= i, j <=
    // 2^height.
    [[nodiscard]] std::array<int64_t, 2> global(int64_t i, int64_t j) const {
        return {corner[0].i + i * step(corner[0].i, corner[1].i) + j * step(corner[0].i, corner[2].i),
                corner[0].j + i * step(corner[0].j, corner[1].j) + j * step(corner[0].j, corner[2].j)};
    }
    [[nodiscard]] Point<double> position(const Placement& placement, int64_t i, int64_t j) const {
        const auto [gi, gj] = global(i, j);
        return placement.at(gi, gj, level);
    }
    [[nodiscard]] std::array<Point<double>, 3> corners(const Placement& placement) const {
        const int64_t n = int64_t{1} << height;
        return {position(placement, 0, 0), position(placement, n, 0), position(placement, 0, n)};
    }
    [[nodiscard]] Point<Bounded> boundedPosition(const Placement& placement, int64_t i, int64_t j) const {
        const auto [gi, gj] = global(i, j);
        return placement.boundedAt(gi, gj, level);
    }

  private:
    [[nodiscard]] int64_t step(uint32_t from, uint32_t to) const {
        return (static_cast<int64_t>(to) - static_cast<int64_t>(from)) >> height;
    }
};

// One bit for each micro-triangle of a tile, in curve order.
class Plane {
  public:
    static constexpr size_t words = size_t{1} << (2 * tileLevel - 6);

    [[nodiscard]] bool test(uint32_t index) const { return (words_[index / 64] >> (index % 64)) & 1; }
    void set(uint32_t index) { words_[index / 64] |= uint64_t{1} << (index % 64); }
    void clear(uint32_t index) { words_[index / 64] &= ~(uint64_t{1} << (index % 64)); }
    // Sets the bits [first, end).
    void setRange(uint32_t first, uint32_t end);
    // The first index >= from whose bit is `value`, or `end` when there is none before it.
    [[nodiscard]] uint32_t find(bool value, uint32_t from, uint32_t end) const;
    uint64_t& word(size_t k) { return words_[k]; }
    [[nodiscard]] uint64_t word(size_t k) const { return words_[k]; }
    // Zeroes the words that 4^height bits need.
    void reset(unsigned height);

  private:
    std::array<uint64_t, words> words_;
};

// The states of a tile: plane `side` is bit 0 of each state, plane `unknown` bit 1.
struct Tile {
    unsigned height = 0;
    Plane unknown;
    Plane side;

    [[nodiscard]] uint32_t count() const { return 1u << (2 * height); }
    void reset(unsigned levels) {
        height = levels;
        unknown.reset(levels);
        side.reset(levels);
    }
};

// Between places in a tile's lattice and curve indices, by table.
class TileCurve {
  public:
    // The table for tiles of 4^height micro-triangles, height <= tileLevel.
    static const TileCurve& of(unsigned height);

    // A place as one number, below 2 * 4^height.
    [[nodiscard]] uint32_t key(uint32_t i, uint32_t j, bool flipped) const {
        return (j << (height_ + 1)) | (i << 1) | (flipped ? 1u : 0u);
    }
    [[nodiscard]] uint32_t index(uint32_t placeKey) const { return index_[placeKey]; }
    [[nodiscard]] uint32_t index(uint32_t i, uint32_t j, bool flipped) const {
        return index_[key(i, j, flipped)];
    }
    [[nodiscard]] micromap::LatticeTriangle triangle(uint32_t index) const { return triangle_[index]; }

  private:
    explicit TileCurve(unsigned height);
    unsigned height_;
    std::vector<uint16_t> index_;
    std::vector<micromap::LatticeTriangle> triangle_;
};

// Appends the tile, whose micro-triangles are those of the finest level, as a canonical quadtree stream
// (micromap/quadtree.h). With `twoState`, unknowns become their side. Returns the state when all of it is one
// leaf, else -1.
int appendTile(const Tile& tile, bool twoState, BitWriter& stream);

}  // namespace filigree::bake
