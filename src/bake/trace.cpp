#include "bake/trace.h"

#include "bake/crossing.h"
#include "bake/rows.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace filigree::bake {
namespace {

std::array<Point<double>, 3> cornersOf(const SubTriangle& part, const Placement& placement) {
    const int64_t n = int64_t{1} << part.height;
    return {part.position(placement, 0, 0), part.position(placement, n, 0), part.position(placement, 0, n)};
}

double marginOf(const Placement& placement, double guard) {
    return guard + 2 * placement.slack() + 1e-12;
}

// One lattice coordinate as a function of a point, and how far the guard and rounding reach in it.
struct Coordinate {
    double perX = 0;
    double perY = 0;
    double constant = 0;
    double rounding = 0;  // bounds the error of at(), lattice steps
    double reach = 0;     // guard and rounding, lattice steps
    double length = 0;    // lattice steps for each texel of distance

    [[nodiscard]] double at(double x, double y) const { return constant + perX * x + perY * y; }
};

// The lattice coordinates of points relative to the sub-triangle's first corner: micro-triangles lie between
// whole numbers of a, b and c = n - a - b.
struct LatticeFrame {
    Point<double> origin;
    Coordinate a;
    Coordinate b;
    Coordinate c;
    double rounding = 0;  // the worst of the three
    bool valid = false;   // false for triangles too thin to be measured so

    LatticeFrame(const SubTriangle& part, const Placement& placement, double guard) {
        const auto corners = cornersOf(part, placement);
        const double n = static_cast<double>(int64_t{1} << part.height);
        origin = corners[0];
        const double ux = (corners[1].x - origin.x) / n;
        const double uy = (corners[1].y - origin.y) / n;
        const double vx = (corners[2].x - origin.x) / n;
        const double vy = (corners[2].y - origin.y) / n;
        const double area = ux * vy - uy * vx;
        const double size = std::max({std::fabs(ux), std::fabs(uy), std::fabs(vx), std::fabs(vy)});
        a = {vy / area, -vx / area, 0, 0, 0, 0};
        b = {-uy / area, ux / area, 0, 0, 0, 0};
        c = {-a.perX - b.perX, -a.perY - b.perY, n, 0, 0, 0};
        for (Coordinate* coordinate : {&a, &b, &c}) {
            const double steps = std::fabs(coordinate->perX) + std::fabs(coordinate->perY);
            const double thinness = steps * size;
            // Pieces are single precision within their cell; positions are off by the placement's slack; the
            // coefficients lose what `area` cancels.
            coordinate->rounding = steps * (2e-7 + 16 * placement.slack() * (1 + thinness)) +
                                   1e-14 * n * thinness * (1 + thinness) + 1e-9;
            coordinate->reach = steps * guard + coordinate->rounding;
            coordinate->length = std::hypot(coordinate->perX, coordinate->perY);
        }
        rounding = std::max({a.rounding, b.rounding, c.rounding});
        valid = rounding < 1e-2;
    }
};

struct Span {
    double low;
    double high;
    Span(double p, double q, double reach) : low(std::min(p, q) - reach), high(std::max(p, q) + reach) {}
};

// Carries pieces of one layer's outline into one tile.
class Tracer {
  public:
    Tracer(const SubTriangle& part, const Placement& placement, const image::Outline& outline, double guard,
           Tile& tile)
        : part_(part),
          outline_(outline),
          curve_(TileCurve::of(part.height)),
          test_(part, placement, outline, guard),
          frame_(part, placement, guard),
          rows_(cornersOf(part, placement), marginOf(placement, guard)),
          n_(int32_t{1} << part.height),
          reach_(std::max({frame_.a.reach, frame_.b.reach, frame_.c.reach}) + frame_.rounding),
          length_(std::max({frame_.a.length, frame_.b.length, frame_.c.length})),
          tile_(tile) {
        left_ = tile.count();
        for (uint32_t k = 0; k < tile.count(); k += 64) {
            left_ -= static_cast<uint32_t>(std::popcount(tile.unknown.word(k / 64)));
        }
    }

    void run() {
        for (int64_t row = rows_.firstRow(); row <= rows_.lastRow() && left_ > 0; ++row) {
            const TriangleRows::Columns columns = rows_.columns(row);
            outline_.forEachPiece(row, columns.first, columns.last,
                                  [&](int64_t offset, std::span<const image::OutlinePiece> pieces) {
                                      for (const image::OutlinePiece& piece : pieces) {
                                          addInCell({offset + piece.cell, row}, piece);
                                      }
                                      return left_ > 0;
                                  });
        }
    }

  private:
    struct Cell {
        int64_t x;
        int64_t y;
    };

    void addInCell(const Cell& cell, const image::OutlinePiece& piece) {
        const Point<double> base{static_cast<double>(cell.x) - frame_.origin.x,
                                 static_cast<double>(cell.y) - frame_.origin.y};
        if (!frame_.valid) {
            testAll(cell, piece);
        } else if (!addInOne(base, piece)) {
            add(cell, base, piece, 0);
        }
    }

    // The usual case: all of a piece lies well inside one micro-triangle. False where it does not.
    bool addInOne(const Point<double>& base, const image::OutlinePiece& piece) {
        const double a = frame_.a.at(base.x, base.y);
        const double b = frame_.b.at(base.x, base.y);
        const double pa = a + (frame_.a.perX * piece.x0 + frame_.a.perY * piece.y0);
        const double pb = b + (frame_.b.perX * piece.x0 + frame_.b.perY * piece.y0);
        const double qa = a + (frame_.a.perX * piece.x1 + frame_.a.perY * piece.y1);
        const double qb = b + (frame_.b.perX * piece.x1 + frame_.b.perY * piece.y1);
        const auto i = static_cast<int32_t>(pa);
        const auto j = static_cast<int32_t>(pb);
        const double reach = reach_ + piece.bulge * length_;
        const double lowA = std::min(pa, qa) - i;
        const double lowB = std::min(pb, qb) - j;
        const double lowSum = std::min(pa + pb, qa + qb) - (i + j);
        const double highSum = std::max(pa + pb, qa + qb) - (i + j);
        if (lowA < reach || lowB < reach || i + j >= n_) return false;
        if (highSum < 1 - reach) {
            mark(curve_.index(static_cast<uint32_t>(i), static_cast<uint32_t>(j), false));
            return true;
        }
        const double highA = std::max(pa, qa) - i;
        const double highB = std::max(pb, qb) - j;
        if (lowSum < 1 + reach || highA > 1 - reach || highB > 1 - reach || i + j + 2 > n_) return false;
        mark(curve_.index(static_cast<uint32_t>(i), static_cast<uint32_t>(j), true));
        return true;
    }

    // Marks what a piece crosses; `base` is the cell relative to the frame's origin.
    void add(const Cell& cell, const Point<double>& base, const image::OutlinePiece& piece, int depth) {
        const Point<double> p{base.x + piece.x0, base.y + piece.y0};
        const Point<double> q{base.x + piece.x1, base.y + piece.y1};
        const Point<double> lp{frame_.a.at(p.x, p.y), frame_.b.at(p.x, p.y)};
        const Point<double> lq{frame_.a.at(q.x, q.y), frame_.b.at(q.x, q.y)};
        const Span a(lp.x, lq.x, frame_.a.reach + piece.bulge * frame_.a.length);
        const Span b(lp.y, lq.y, frame_.b.reach + piece.bulge * frame_.b.length);
        const Span c(n_ - lp.x - lp.y, n_ - lq.x - lq.y, frame_.c.reach + piece.bulge * frame_.c.length);
        if (a.high < 0 || b.high < 0 || c.high < 0) return;
        const double dx = std::fabs(lp.x - lq.x) + 2 * piece.bulge * frame_.a.length;
        const double dy = std::fabs(lp.y - lq.y) + 2 * piece.bulge * frame_.b.length;
        if (std::max(dx, dy) > longest && depth < deepest) {
            const image::Patch patch = outline_.patch(cell.x, cell.y);
            if (const auto halves = outline_.split(piece, patch)) {
                add(cell, base, (*halves)[0], depth + 1);
                add(cell, base, (*halves)[1], depth + 1);
                return;
            }
        }
        markAt(lp);
        markAt(lq);
        testNear(cell, piece, a, b, c);
    }

    // A micro-triangle that holds a point of the outline well inside is crossed for sure.
    void markAt(const Point<double>& p) {
        const double margin = 2 * frame_.rounding;
        const auto i = static_cast<int32_t>(floorToInt(p.x));
        const auto j = static_cast<int32_t>(floorToInt(p.y));
        const double fi = p.x - i;
        const double fj = p.y - j;
        if (i < 0 || j < 0 || fi < margin || fj < margin || fi > 1 - margin || fj > 1 - margin) return;
        const bool flipped = fi + fj > 1;
        if (i + j + (flipped ? 2 : 1) > n_ || std::fabs(fi + fj - 1) < margin) return;
        mark(curve_.index(static_cast<uint32_t>(i), static_cast<uint32_t>(j), flipped));
    }

    void mark(uint32_t index) {
        if (tile_.unknown.test(index)) return;
        tile_.unknown.set(index);
        --left_;
    }

    // Tests each micro-triangle that meets the three spans and is not marked yet.
    void testNear(const Cell& cell, const image::OutlinePiece& piece, const Span& a, const Span& b,
                  const Span& c) {
        const auto firstI = static_cast<int32_t>(floorToInt(std::max(a.low, 0.0)));
        const auto lastI = static_cast<int32_t>(floorToInt(std::min(a.high, n_ - 1.0)));
        const auto firstJ = static_cast<int32_t>(floorToInt(std::max(b.low, 0.0)));
        const auto lastJ = static_cast<int32_t>(floorToInt(std::min(b.high, n_ - 1.0)));
        for (int32_t j = firstJ; j <= lastJ; ++j) {
            for (int32_t i = firstI; i <= lastI; ++i) {
                const int32_t k =
                    n_ - 1 - i - j;  // c of an upright one runs from k to k + 1, of a flipped from k - 1
                if (k < 0) break;
                if (k <= c.high && k + 1 >= c.low) testOne(cell, piece, i, j, false);
                if (k > 0 && k - 1 <= c.high && k >= c.low) testOne(cell, piece, i, j, true);
            }
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
    const TileCurve& curve_;
    CrossingTest test_;
    LatticeFrame frame_;
    TriangleRows rows_;
    int32_t n_;
    double reach_;   // the furthest that guard and rounding reach in any lattice coordinate
    double length_;  // the most lattice steps for a texel
    Tile& tile_;
    uint32_t left_;
};

}  // namespace

bool mayCross(const SubTriangle& part, const Placement& placement, const image::Outline& outline,
              double guard) {
    if (outline.empty()) return false;
    const TriangleRows rows(cornersOf(part, placement), marginOf(placement, guard));
    for (int64_t row = rows.firstRow(); row <= rows.lastRow(); ++row) {
        const TriangleRows::Columns columns = rows.columns(row);
        if (outline.crosses(row, columns.first, columns.last)) return true;
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
