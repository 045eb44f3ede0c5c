// Hierarchical prediction inside a patch of 5 x 5 places (docs/spec/lattice.md, "Patch").
#pragma once

#include "filigree/grid/lattice.h"

#include "grid/tile_layout.h"

#include <cstddef>
#include <cstdint>

namespace filigree::grid {

// Arithmetic modulo 2^32 and, of coordinates, modulo 2^24.
constexpr int32_t wrapped(uint32_t value) {
    return static_cast<int32_t>(value);
}
constexpr int32_t wrappedPoint(int32_t value) {
    return value & (latticeLimit - 1);
}
constexpr int32_t wrappedResidual(int32_t value) {
    return wrapped(static_cast<uint32_t>(value) << 8) >> 8;
}
constexpr int32_t wrappedSum(int32_t p, int32_t q) {
    return wrapped(static_cast<uint32_t>(p) + static_cast<uint32_t>(q));
}
constexpr int32_t wrappedDifference(int32_t p, int32_t q) {
    return wrapped(static_cast<uint32_t>(p) - static_cast<uint32_t>(q));
}
constexpr int32_t wrappedProduct(int32_t p, int32_t q) {
    return wrapped(static_cast<uint32_t>(p) * static_cast<uint32_t>(q));
}

constexpr int32_t half(int32_t p, int32_t q) {
    return (p + q + 1) >> 1;
}
// Place 2 of places 0 and 4.
constexpr int32_t mid(int32_t p, int32_t q, unsigned steps) {
    return steps == 3 ? p + ((85 * (q - p) + 128) >> 8) : half(p, q);
}

// What a bend of 2 m - p - q around a line's middle m adds to its quarters.
constexpr int32_t curveOf(unsigned curve, int32_t bend) {
    return (static_cast<int32_t>(curve) * bend + 16) >> 5;
}

// The points of a patch inside an array of `stride` points a row.
class Patch {
  public:
    Patch(LatticePoint* first, size_t stride, unsigned columns, unsigned rows, unsigned curve)
        : first_(first), stride_(stride), columns_(columns), rows_(rows), curve_(curve) {}

    LatticePoint& at(unsigned x, unsigned y) { return first_[y * stride_ + x]; }
    [[nodiscard]] const LatticePoint& at(unsigned x, unsigned y) const { return first_[y * stride_ + x]; }

    // Calls visit(x, y, class, prediction) for each vertex but the corners, after those it is predicted from;
    // visit may set the vertex.
    template <class Visit>
    void walk(const Visit& visit) {
        walkEdges(visit);
        if (midsOf(columns_) * midsOf(rows_) == 0) return;
        visit(2, 2, insideCentre, centrePrediction());
        walkCrosses(visit);
        for (const unsigned y : {1, 3})
            for (const unsigned x : {1, 3})
                if (isPlace(columns_, x) && isPlace(rows_, y))
                    visit(x, y, insideDiagonal, diagonalPrediction(x, y));
    }

    // The bend that the curve takes part of, at a quarter of an edge or a cross.
    [[nodiscard]] LatticePoint bendAt(unsigned x, unsigned y) const {
        const bool across = x % 2 != 0;
        if ((across ? columns_ : rows_) != 4) return {};
        const LatticePoint& two = across ? at(2, y) : at(x, 2);
        const LatticePoint& low = across ? at(0, y) : at(x, 0);
        const LatticePoint& high = across ? at(4, y) : at(x, 4);
        return perAxis([&](size_t k) { return 2 * two[k] - low[k] - high[k]; });
    }

  private:
    template <class Of>
    static LatticePoint perAxis(const Of& of) {
        return {of(0), of(1), of(2)};
    }
    // Between places 2 and `end` of five in a line, of which `other` is the far end.
    [[nodiscard]] LatticePoint quarter(const LatticePoint& end, const LatticePoint& two,
                                       const LatticePoint& other, unsigned steps) const {
        const unsigned curve = steps == 4 ? curve_ : 0;
        return perAxis(
            [&](size_t k) { return half(end[k], two[k]) + curveOf(curve, 2 * two[k] - end[k] - other[k]); });
    }
    [[nodiscard]] LatticePoint middle(const LatticePoint& p, const LatticePoint& q, unsigned steps) const {
        return perAxis([&](size_t k) { return mid(p[k], q[k], steps); });
    }

    template <class Visit>
    void walkEdges(const Visit& visit) {
        if (midsOf(columns_) != 0)
            for (const unsigned y : {0, 4}) {
                visit(2, y, edgeMid, middle(at(0, y), at(4, y), columns_));
                if (isPlace(columns_, 1))
                    visit(1, y, edgeQuarter, quarter(at(0, y), at(2, y), at(4, y), columns_));
                if (isPlace(columns_, 3))
                    visit(3, y, edgeQuarter, quarter(at(4, y), at(2, y), at(0, y), columns_));
            }
        if (midsOf(rows_) != 0)
            for (const unsigned x : {0, 4}) {
                visit(x, 2, edgeMid, middle(at(x, 0), at(x, 4), rows_));
                if (isPlace(rows_, 1)) visit(x, 1, edgeQuarter, quarter(at(x, 0), at(x, 2), at(x, 4), rows_));
                if (isPlace(rows_, 3)) visit(x, 3, edgeQuarter, quarter(at(x, 4), at(x, 2), at(x, 0), rows_));
            }
    }
    template <class Visit>
    void walkCrosses(const Visit& visit) {
        if (isPlace(rows_, 1)) visit(2, 1, insideCross, quarter(at(2, 0), at(2, 2), at(2, 4), rows_));
        if (isPlace(columns_, 1)) visit(1, 2, insideCross, quarter(at(0, 2), at(2, 2), at(4, 2), columns_));
        if (isPlace(columns_, 3)) visit(3, 2, insideCross, quarter(at(4, 2), at(2, 2), at(0, 2), columns_));
        if (isPlace(rows_, 3)) visit(2, 3, insideCross, quarter(at(2, 4), at(2, 2), at(2, 0), rows_));
    }
    [[nodiscard]] LatticePoint centrePrediction() const {
        return perAxis([&](size_t k) {
            const int32_t top = mid(at(0, 0)[k], at(4, 0)[k], columns_);
            const int32_t bottom = mid(at(0, 4)[k], at(4, 4)[k], columns_);
            return mid(at(0, 2)[k], at(4, 2)[k], columns_) + mid(at(2, 0)[k], at(2, 4)[k], rows_) -
                   mid(top, bottom, rows_);
        });
    }
    [[nodiscard]] LatticePoint diagonalPrediction(unsigned x, unsigned y) const {
        return perAxis([&](size_t k) {
            const int32_t beside = at(x - 1, y)[k] + at(x + 1, y)[k] + at(x, y - 1)[k] + at(x, y + 1)[k];
            const int32_t around =
                at(x - 1, y - 1)[k] + at(x + 1, y - 1)[k] + at(x - 1, y + 1)[k] + at(x + 1, y + 1)[k];
            return (2 * beside - around + 2) >> 2;
        });
    }

    LatticePoint* first_;
    size_t stride_;
    unsigned columns_;
    unsigned rows_;
    unsigned curve_;
};

}  // namespace filigree::grid
