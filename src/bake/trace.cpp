#include "bake/trace.h"

#include "bake/crossing.h"
#include "bake/lattice.h"
#include "bake/place.h"
#include "bake/rows.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace filigree::bake {
namespace {

double marginOf(const Placement& placement, double guard) {
    return guard + 2 * placement.slack() + 1e-12;
}

// The longest side of the box around a triangle.
double extentOf(const std::array<Point<double>, 3>& p) {
    const auto side = [](double a, double b, double c) { return std::max({a, b, c}) - std::min({a, b, c}); };
    return std::max(side(p[0].x, p[1].x, p[2].x), side(p[0].y, p[1].y, p[2].y));
}

// Carries pieces of one layer's outline into one tile.
class Tracer {
  public:
    Tracer(const SubTriangle& part, const Placement& placement, const image::Outline& outline, double guard,
           Tile& tile)
        : part_(part),
          outline_(outline),
          guard_(guard),
          curve_(TileCurve::of(part.height)),
          test_(part, placement, outline, guard),
          frame_(part, placement, guard),
          rows_(part.corners(placement), marginOf(placement, guard)),
          n_(int32_t{1} << part.height),
          tile_(tile) {
        placeable_ = makePlaceFrame(extentOf(part.corners(placement)) + guard);
        left_ = tile.count();
        for (uint32_t k = 0; k < tile.count(); k += 64) {
            left_ -= static_cast<uint32_t>(std::popcount(tile.unknown.word(k / 64)));
        }
    }

    void run() {
        for (int64_t row = rows_.firstRow(); row <= rows_.lastRow() && left_ > 0;) {
            row = skipBareCopies(row);
            const int64_t last = std::min(outline_.bandEnd(row), rows_.lastRow());
            const TriangleRows::Columns columns = rows_.columns(row, last);
            outline_.forEachRun({row, last, columns.first, columns.last},
                                [&](const image::Outline::Run& all) {
                                    addRun(all);
                                    return left_ > 0;
                                });
            row = last + 1;
        }
    }

  private:
    struct Cell {
        int64_t x;
        int64_t y;
    };

    // The first row from `row` on to look at: of rows beyond a clamped border, a triangle may hold millions.
    [[nodiscard]] int64_t skipBareCopies(int64_t row) const {
        int64_t last = std::min(outline_.alikeEnd(row), rows_.lastRow());
        if (last == outline_.bandEnd(row)) return row;
        for (; last > row; last = row + (last - row) / 2) {
            const TriangleRows::Columns columns = rows_.columns(row, last);
            if (!outline_.crosses({row, last, columns.first, columns.last})) return last;
        }
        return row;
    }

    void addRun(const image::Outline::Run& all) {
        image::Outline::Run part = all;
        for (; part.first < all.end; part.first += Places::capacity) {
            part.end = std::min(all.end, part.first + Places::capacity);
            if (placeable_) {
                placePieces(outline_.pieceArrays(), part, place_, places_);
            } else {
                places_.first.fill(placeUnclear);
            }
            for (size_t k = part.first; k < part.end; ++k) {
                const int32_t first = places_.first[k - part.first];
                const int32_t second = places_.second[k - part.first];
                if (first == placeUnclear) {
                    addPiece(part, k);
                    continue;
                }
                if (first >= 0) mark(curve_.index(static_cast<uint32_t>(first)));
                if (second >= 0 && second != first) mark(curve_.index(static_cast<uint32_t>(second)));
            }
        }
    }

    void addPiece(const image::Outline::Run& run, size_t k) {
        const image::OutlinePiece piece = outline_.piece(k);
        const Cell cell{run.column + piece.cell, run.row + piece.row};
        if (!frame_.valid) return testAll(cell, piece);
        add(cell,
            {static_cast<double>(cell.x) - frame_.origin.x, static_cast<double>(cell.y) - frame_.origin.y},
            piece, 0);
    }

    // The frame in single precision. False where the tile is too wide for it.
    bool makePlaceFrame(double extent) {
        const double reach = std::max({frame_.a.reach, frame_.b.reach, frame_.c.reach}) + frame_.rounding;
        const double length = std::max({frame_.a.length, frame_.b.length, frame_.c.length});
        const double steps = std::max({frame_.a.steps(), frame_.b.steps(), frame_.c.steps()});
        const double single = 1e-6 * (steps * (extent + 16) + n_);
        place_.column = static_cast<int32_t>(floorToInt(frame_.origin.x));
        place_.row = static_cast<int32_t>(floorToInt(frame_.origin.y));
        const double x = frame_.origin.x - place_.column;
        const double y = frame_.origin.y - place_.row;
        place_.ax = static_cast<float>(frame_.a.perX);
        place_.ay = static_cast<float>(frame_.a.perY);
        place_.a0 = static_cast<float>(-(frame_.a.perX * x + frame_.a.perY * y));
        place_.bx = static_cast<float>(frame_.b.perX);
        place_.by = static_cast<float>(frame_.b.perY);
        place_.b0 = static_cast<float>(-(frame_.b.perX * x + frame_.b.perY * y));
        place_.reach = static_cast<float>((reach + single) * 1.000001);
        place_.length = static_cast<float>(length * 1.000001);
        place_.steps = static_cast<float>(n_);
        place_.rowShift = static_cast<int32_t>(part_.height) + 1;
        return frame_.valid && single < 0.05 && extent < 1e6;
    }

    // Marks what a piece crosses; `base` is the cell relative to the frame's origin.
    void add(const Cell& cell, const Point<double>& base, const image::OutlinePiece& piece, int depth) {
        const LatticeChord chord(frame_, guard_, {base.x + piece.x0, base.y + piece.y0},
                                 {base.x + piece.x1, base.y + piece.y1}, piece.bulge);
        if (chord.a.outer.high < 0 || chord.b.outer.high < 0 || chord.c.outer.high < 0 || left_ == 0) return;
        // A part shorter than the guard's reach is near all that the whole is near.
        if (chord.extent() > std::max({longest, frame_.a.reach, frame_.b.reach}) && depth < deepest) {
            if (const auto halves = outline_.split(piece, outline_.patch(cell.x, cell.y))) {
                add(cell, base, (*halves)[0], depth + 1);
                add(cell, base, (*halves)[1], depth + 1);
                return;
            }
        }
        testNear(cell, piece, chord);
    }

    void mark(uint32_t index) {
        left_ -= tile_.unknown.test(index) ? 0 : 1;
        tile_.unknown.set(index);
    }

    // Looks at each micro-triangle next to the chord that is not marked yet.
    void testNear(const Cell& cell, const image::OutlinePiece& piece, const LatticeChord& chord) {
        const auto firstI = static_cast<int32_t>(floorToInt(std::max(chord.a.outer.low, 0.0)));
        const auto lastI = static_cast<int32_t>(floorToInt(std::min(chord.a.outer.high, n_ - 1.0)));
        const auto firstJ = static_cast<int32_t>(floorToInt(std::max(chord.b.outer.low, 0.0)));
        const auto lastJ = static_cast<int32_t>(floorToInt(std::min(chord.b.outer.high, n_ - 1.0)));
        for (int32_t j = firstJ; j <= lastJ; ++j) {
            for (int32_t i = firstI; i <= lastI && i + j < n_; ++i) {
                consider(cell, piece, chord, i, j, false);
                if (i + j + 1 < n_) consider(cell, piece, chord, i, j, true);
            }
        }
    }

    void consider(const Cell& cell, const image::OutlinePiece& piece, const LatticeChord& chord, int32_t i,
                  int32_t j, bool flipped) {
        const uint32_t index = curve_.index(static_cast<uint32_t>(i), static_cast<uint32_t>(j), flipped);
        if (tile_.unknown.test(index)) return;
        switch (chord.meets(i, j, flipped)) {
            case LatticeChord::Meeting::no:
                return;
            case LatticeChord::Meeting::yes:
                return mark(index);
            case LatticeChord::Meeting::unclear:
                return testOne(cell, piece, i, j, flipped);
        }
    }

    void testOne(const Cell& cell, const image::OutlinePiece& piece, int32_t i, int32_t j, bool flipped) {
        const auto ui = static_cast<uint32_t>(i);
        const auto uj = static_cast<uint32_t>(j);
        const uint32_t index = curve_.index(ui, uj, flipped);
        if (tile_.unknown.test(index)) return;
        if (test_.crosses({ui, uj, flipped}, cell.x, cell.y, outline_.patch(cell.x, cell.y), piece))
            mark(index);
    }

    // Without a frame: every micro-triangle of the tile.
    void testAll(const Cell& cell, const image::OutlinePiece& piece) {
        for (uint32_t index = 0; index < tile_.count(); ++index) {
            const micromap::LatticeTriangle t = curve_.triangle(index);
            testOne(cell, piece, static_cast<int32_t>(t.i), static_cast<int32_t>(t.j), t.flipped);
        }
    }

    static constexpr double longest = 2.5;  // lattice steps that a piece may span before it is split
    static constexpr int deepest = 16;

    const SubTriangle& part_;
    const image::Outline& outline_;
    double guard_;
    const TileCurve& curve_;
    CrossingTest test_;
    LatticeFrame frame_;
    TriangleRows rows_;
    int32_t n_;
    PlaceFrame place_;
    Places places_;
    bool placeable_;
    Tile& tile_;
    uint32_t left_;
};

}  // namespace

bool mayCross(const SubTriangle& part, const Placement& placement, const image::Outline& outline,
              double guard) {
    if (outline.empty()) return false;
    const TriangleRows rows(part.corners(placement), marginOf(placement, guard));
    for (int64_t row = rows.firstRow(); row <= rows.lastRow();) {
        const int64_t last = std::min(outline.alikeEnd(row), rows.lastRow());
        const TriangleRows::Columns columns = rows.columns(row, last);
        if (outline.crosses({row, last, columns.first, columns.last})) return true;
        row = last + 1;
    }
    return false;
}

bool isTraceable(const SubTriangle& part, const Placement& placement, double guard) {
    return LatticeFrame(part, placement, guard).valid;
}

void markCrossed(const SubTriangle& part, const Placement& placement, const image::Outline& outline,
                 double guard, Tile& tile) {
    if (outline.empty()) return;
    Tracer(part, placement, outline, guard, tile).run();
}

}  // namespace filigree::bake
