// Three-state opacity maps of squares: one for each pair of triangles (Fenney and Ozkan 2023).
#pragma once

#include "filigree/core/api.h"

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace filigree::quadmap {

// What is known of a region of a square; the paper's T, C and O. `free` regions are those that nobody looks
// up, such as the other half of a single triangle's square: any state may stand there.
enum class Region : uint8_t { transparent = 0, mixed = 1, opaque = 2, free = 3 };

// Transparent or opaque: no any-hit shader has to run.
constexpr bool isKnown(Region region) {
    return region == Region::transparent || region == Region::opaque;
}

// side x side regions over the unit square, row by row, row 0 at the top.
struct Square {
    unsigned side = 0;
    std::vector<Region> regions;  // [side * side]

    Square() = default;
    explicit Square(unsigned sideLength, Region all = Region::mixed)
        : side(sideLength), regions(size_t{sideLength} * sideLength, all) {}

    [[nodiscard]] Region at(unsigned x, unsigned y) const { return regions[place(x, y)]; }
    Region& at(unsigned x, unsigned y) { return regions[place(x, y)]; }
    friend bool operator==(const Square&, const Square&) = default;

  private:
    [[nodiscard]] size_t place(unsigned x, unsigned y) const {
        assert(x < side && y < side);
        return size_t{y} * side + x;
    }
};

// Alpha tests that the map saves: the share of transparent and opaque regions among those that are not free,
// 0..1; 0 where all are free (section 4.3 of the paper).
FILIGREE_API double savings(const Square& square);

// The regions that are transparent or opaque in `source` and mixed in `map`, of the same side.
FILIGREE_API uint32_t substitutions(const Square& source, const Square& map);

// True when every transparent or opaque region of `map` is the same, or free, in `source`.
FILIGREE_API bool isConservative(const Square& source, const Square& map);

}  // namespace filigree::quadmap
