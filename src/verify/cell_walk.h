// Walks a segment through the cells of the unit grid, in rounded or exact arithmetic (see outline.h).
#pragma once

#include "verify/outline.h"

#include <cstdint>

namespace filigree::verify {

// One coordinate of the walk: the cell it is in and when it leaves it. Times run from 0 to 1 along the
// segment.
template <class Number>
struct WalkAxis {
    using Time = decltype(quotient(Number(), Number()));

    WalkAxis(const Number& from, const Number& to, const Number& unit)
        : start(from), delta(to - from), one(unit), cell(floorQuotient(from, unit)) {
        schedule();
    }
    void step() {
        cell += delta < 0 ? -1 : 1;
        schedule();
    }
    void schedule() {
        if (delta == 0) {
            leaves = quotient(Number(2), Number(1));  // never: later than the end
            return;
        }
        const Number line = Number(delta < 0 ? cell : cell + 1) * one;
        leaves = quotient(Number(line - start), delta);
    }

    Number start;
    Number delta;
    Number one;
    int64_t cell;
    Time leaves{};
};

// Calls visit(x, y, from, to) for the pieces of the segment a-b in turn: the cell [x, x+1] x [y, y+1] holds
// the times from..to of the segment. Pieces may have no length. Ends early when visit returns false.
template <class Number, class Visit>
void walkCells(const Point<Number>& a, const Point<Number>& b, const Number& one, Visit&& visit) {
    WalkAxis<Number> x(a.x, b.x, one);
    WalkAxis<Number> y(a.y, b.y, one);
    const auto end = quotient(Number(1), Number(1));
    auto from = quotient(Number(0), Number(1));
    while (true) {
        WalkAxis<Number>& first = y.leaves < x.leaves ? y : x;
        if (!(first.leaves < end)) {
            visit(x.cell, y.cell, from, end);
            return;
        }
        if (!visit(x.cell, y.cell, from, first.leaves)) return;
        from = first.leaves;
        first.step();
    }
}

}  // namespace filigree::verify
