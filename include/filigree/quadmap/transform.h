// The eight symmetries of a square, as table 1 of Fenney and Ozkan 2023 builds them.
#pragma once

#include "filigree_lookup.h"

#include <cstdint>

namespace filigree::quadmap {

// Three steps, each done or not: bit 0 rotate by 90 degrees anticlockwise, then bit 1 reflect top/bottom,
// then bit 2 reflect left/right. So 0 is the identity, 6 a rotation by 180 degrees, 7 by 270.
using Transform = uint8_t;

// How many transforms there are.
inline constexpr unsigned transformCount = 8;

// A place in a grid, column and row; row 0 at the top.
struct Cell {
    unsigned x = 0;
    unsigned y = 0;
};

// The cell of a stored `side` x `side` grid that stands at `shown` once the grid is transformed. The side is
// a power of two.
constexpr Cell storedCell(Transform transform, unsigned side, Cell shown) {
    const filigree_cell stored = filigree_stored_cell(transform, side, shown.x, shown.y);
    return {stored.x, stored.y};
}

// The transform that undoes `transform`: the two quarter turns undo each other, the others themselves.
constexpr Transform inverse(Transform transform) {
    return transform == 1 ? 7 : transform == 7 ? 1 : transform;
}

// The transform that does `first`, then `second`.
constexpr Transform compose(Transform second, Transform first) {
    const auto corner = [&](Cell cell) { return storedCell(first, 4, storedCell(second, 4, cell)); };
    for (Transform both = 0; both < transformCount; ++both) {
        const Cell a = storedCell(both, 4, {0, 0});
        const Cell b = storedCell(both, 4, {3, 0});
        const Cell c = corner({0, 0});
        const Cell d = corner({3, 0});
        if (a.x == c.x && a.y == c.y && b.x == d.x && b.y == d.y) return both;
    }
    return 0;
}

// `cells` of a side x side grid, bit y * side + x each, transformed.
constexpr uint32_t transformedCells(Transform transform, unsigned side, uint32_t cells) {
    uint32_t shown = 0;
    for (unsigned y = 0; y < side; ++y) {
        for (unsigned x = 0; x < side; ++x) {
            const Cell from = storedCell(transform, side, {x, y});
            shown |= (cells >> (from.y * side + from.x) & 1) << (y * side + x);
        }
    }
    return shown;
}

}  // namespace filigree::quadmap
