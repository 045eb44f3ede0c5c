#include "verify/exact.h"

#include "verify/cell_walk.h"

#include <algorithm>
#include <optional>

namespace filigree::verify {
namespace {

// A micro-triangle on integers: one texel is `one`, a power of two. The grid is that of RoundedShape.
struct ExactShape {
    Outline<Big> outline;
    Big one;
};

ExactShape makeShape(const Layer& layer, Filtering filtering, const mesh::UvTriangle& triangle,
                     unsigned level, const micromap::LatticeTriangle& place, double guard) {
    int digits = 0;
    for (const mesh::Uv& uv : triangle.uv) {
        digits = std::max({digits, -lowestBit(double{uv.u}), -lowestBit(double{uv.v})});
    }
    const int shift = std::max(digits + static_cast<int>(level) + 1, -lowestBit(guard));
    const int uvShift = shift - static_cast<int>(level);
    const Big one = Big(1) << static_cast<unsigned>(shift);
    const Big offset = filtering == Filtering::linear ? Big(one / 2) : Big(0);
    const uint32_t n = uint32_t{1} << level;
    const auto points = micromap::corners(place);
    std::array<Point<Big>, 3> corners;
    for (size_t k = 0; k < 3; ++k) {
        const std::array<uint32_t, 3> weights{n - points[k].i - points[k].j, points[k].i, points[k].j};
        for (size_t w = 0; w < 3; ++w) {
            corners[k].x += scaled(double{triangle.uv[w].u}, uvShift) * weights[w] * layer.width();
            corners[k].y += scaled(double{triangle.uv[w].v}, uvShift) * weights[w] * layer.height();
        }
        corners[k].x -= offset;
        corners[k].y -= offset;
    }
    return {widened(corners, scaled(guard, shift)), one};
}

// Texels first..last.
struct Run {
    int64_t first = INT64_MAX;
    int64_t last = INT64_MIN;
};

// The integers that the outline spans in the strip y0..y1: from ceil of its left to floor of its right end.
Run integersInStrip(const ExactShape& shape, const Big& y0, const Big& y1) {
    Run run;
    visitStrip(shape.outline, y0, y1, [&](const Fraction& x) {
        const Big den = x.den * shape.one;
        run.first = std::min(run.first, -floorQuotient(Big(-x.num), den));
        run.last = std::max(run.last, floorQuotient(x.num, den));
    });
    return run;
}

// The rows of grid lines from the one at or below the shape's lowest point to that at or below its highest.
Run rowsOf(const ExactShape& shape) {
    Run rows;
    for (unsigned k = 0; k < shape.outline.count; ++k) {
        const int64_t row = floorQuotient(shape.outline.at[k].y, shape.one);
        rows.first = std::min(rows.first, row);
        rows.last = std::max(rows.last, row);
    }
    return rows;
}

// The sign of scale * f - bound along a segment, times a positive number: a + b t + c t^2.
struct Parabola {
    Big a, b, c;

    [[nodiscard]] int signAt(const Fraction& t) const {
        return Big(a * t.den * t.den + b * t.num * t.den + c * t.num * t.num).sign();
    }
    [[nodiscard]] std::optional<Fraction> vertex() const {
        if (c == 0) return std::nullopt;
        return quotient(Big(-b), Big(2 * c));
    }
};

// Which sides of one threshold occur on a shape.
class Sighting {
  public:
    Sighting(const Layer& layer, const ExactShape& shape, const Threshold& threshold)
        : layer_(layer), shape_(shape), threshold_(threshold) {}

    void linear() {
        atNodes();
        for (unsigned k = 0; k < shape_.outline.count && !both(); ++k) {
            alongEdge(shape_.outline.at[k], shape_.outline.next(k));
        }
    }
    void nearest() {
        const Run rows = rowsOf(shape_);
        for (int64_t row = rows.first - 1; row <= rows.last && !both(); ++row) {
            const Run run = integersInStrip(shape_, Big(row) * shape_.one, Big(row + 1) * shape_.one);
            // Squares are closed: one that ends where the shape begins counts.
            if (run.first <= run.last + 1) addTexels({run.first - 1, run.last, row, row});
        }
    }

    bool above = false;
    bool below = false;

  private:
    [[nodiscard]] bool both() const { return above && below; }

    void addTexels(const TexelBlock& block) {
        if (block.x1 < block.x0) return;
        TexelRange texels;
        layer_.addBlock(block, texels, [](const TexelRange&) { return false; });
        above |= texels.hi >= threshold_.texel;
        below |= texels.lo < threshold_.texel;
    }

    void atNodes() {
        const Run rows = rowsOf(shape_);
        for (int64_t row = rows.first; row <= rows.last && !both(); ++row) {
            const Big y = Big(row) * shape_.one;
            const Run run = integersInStrip(shape_, y, y);
            addTexels({run.first, run.last, row, row});
        }
    }

    void alongEdge(const Point<Big>& a, const Point<Big>& b) {
        walkCells(a, b, shape_.one, [&](int64_t x, int64_t y, const Fraction& from, const Fraction& to) {
            const CellTexels texels = layer_.cell(x, y);
            const auto [least, most] = std::minmax_element(texels.begin(), texels.end());
            if (static_cast<uint32_t>(*least) >= threshold_.texel) {
                above = true;
            } else if (static_cast<uint32_t>(*most) < threshold_.texel) {
                below = true;
            } else {
                addPiece(parabola(texels, x, y, a, b), from, to);
            }
            return !both();
        });
    }

    [[nodiscard]] Parabola parabola(const CellTexels& t, int64_t x, int64_t y, const Point<Big>& a,
                                    const Point<Big>& b) const {
        const Big& one = shape_.one;
        const Big u = a.x - x * one;
        const Big v = a.y - y * one;
        const Big du = b.x - a.x;
        const Big dv = b.y - a.y;
        const int alongU = t[1] - t[0];
        const int alongV = t[2] - t[0];
        const int twist = t[0] - t[1] - t[2] + t[3];
        const Big& scale = threshold_.scale;
        return {scale * (one * (one * t[0] + alongU * u + alongV * v) + twist * u * v) -
                    threshold_.bound * one * one,
                scale * (one * (alongU * du + alongV * dv) + twist * (u * dv + v * du)),
                scale * twist * du * dv};
    }

    void addPiece(const Parabola& parabola, const Fraction& from, const Fraction& to) {
        addSign(parabola.signAt(from));
        addSign(parabola.signAt(to));
        const std::optional<Fraction> vertex = parabola.vertex();
        if (vertex && from < *vertex && *vertex < to) addSign(parabola.signAt(*vertex));
    }
    void addSign(int sign) {
        const bool isAbove = threshold_.strict ? sign > 0 : sign >= 0;
        above |= isAbove;
        below |= !isAbove;
    }

    const Layer& layer_;
    const ExactShape& shape_;
    const Threshold& threshold_;
};

Sighting sight(const Layer& layer, Filtering filtering, const ExactShape& shape, const Threshold& threshold) {
    Sighting sighting(layer, shape, threshold);
    if (filtering == Filtering::linear) {
        sighting.linear();
    } else {
        sighting.nearest();
    }
    return sighting;
}

}  // namespace

Verdict judgeExactly(const Layer& layer, Filtering filtering, const mesh::UvTriangle& triangle,
                     unsigned level, const micromap::LatticeTriangle& place, double guard,
                     const Limits& limits) {
    const ExactShape shape = makeShape(layer, filtering, triangle, level, place, guard);
    const Sighting low = sight(layer, filtering, shape, limits.low);
    const Sighting high = limits.low == limits.high ? low : sight(layer, filtering, shape, limits.high);
    Verdict verdict;
    verdict.maybeNotOpaque = high.below;
    verdict.maybeNotTransparent = low.above;
    verdict.notOpaque = (limits.blend ? high : low).below;
    verdict.notTransparent = (limits.blend ? low : high).above;
    return verdict;
}

}  // namespace filigree::verify
