#include "verify/rounded.h"

#include "verify/cell_walk.h"

#include <algorithm>
#include <cmath>

namespace filigree::verify {
namespace {

struct Box {
    double x0, x1, y0, y1;
};

// A box that surely holds the true shape.
Box boxOf(const RoundedShape& shape) {
    const auto& c = shape.corners;
    const double reach = shape.guard + shape.margin;
    return {std::min({c[0].x, c[1].x, c[2].x}) - reach, std::max({c[0].x, c[1].x, c[2].x}) + reach,
            std::min({c[0].y, c[1].y, c[2].y}) - reach, std::max({c[0].y, c[1].y, c[2].y}) + reach};
}

// The texels that the cells of a box read; a cell of nearest filtering is its texel alone.
TexelBlock texelsOf(const Box& box, Filtering filtering) {
    const int64_t more = filtering == Filtering::linear ? 1 : 0;
    return {floorInt(box.x0), floorInt(box.x1) + more, floorInt(box.y0), floorInt(box.y1) + more};
}

struct Span {
    double lo = std::numeric_limits<double>::infinity();
    double hi = -std::numeric_limits<double>::infinity();
};

// Gathers what a shape reaches, as long as it is not known to be mixed.
class Survey {
    // Texels of both sides stay so, whatever comes to them.
    [[nodiscard]] auto mixedTexels() const {
        return [this](const TexelRange& texels) { return limits_ != nullptr && !limits_->uniform(texels); };
    }

  public:
    Survey(const Layer& layer, Filtering filtering, const RoundedShape& shape, const Limits* limits)
        : layer_(layer), filtering_(filtering), shape_(shape), limits_(limits), box_(boxOf(shape)) {}

    // The texels under the box around the shape. Enough where they are uniform.
    TexelRange boxTexels() const {
        TexelRange texels;
        layer_.addBlock(texelsOf(box_, filtering_), texels, mixedTexels());
        return texels;
    }

    // The texels that are read anywhere on the shape, and few others.
    TexelRange touchedTexels() const {
        TexelRange texels;
        const double margin = shape_.margin;
        for (double y = std::floor(box_.y0); y <= box_.y1; ++y) {
            const Span span = strip(y - margin, y + 1 + margin);
            if (!(span.lo <= span.hi)) continue;
            TexelBlock block = texelsOf({span.lo - margin, span.hi + margin, y, y}, filtering_);
            layer_.addBlock(block, texels, mixedTexels());
            if (mixedTexels()(texels)) break;
        }
        return texels;
    }

    void outline() { outline_ = widened(shape_.corners, shape_.guard); }

    // Looks closely, until the shape is known to be mixed; `texels` are those it touches.
    Reach look(const TexelRange& texels) {
        if (filtering_ == Filtering::linear) {
            alongEdges();
            insideNodes();
        } else {
            insideSquares();
            reach_.outerLo = texels.lo;
            reach_.outerHi = texels.hi;
        }
        reach_.outerLo = std::max(reach_.outerLo, static_cast<double>(texels.lo));
        reach_.outerHi = std::min(reach_.outerHi, static_cast<double>(texels.hi));
        return reach_;
    }

    // The values at the outline's corners: enough for most mixed shapes.
    void atCorners() {
        if (filtering_ == Filtering::nearest) return;
        for (unsigned k = 0; k < outline_.count; ++k) {
            const Point<double>& p = outline_.at[k];
            const int64_t x = floorInt(p.x);
            const int64_t y = floorInt(p.y);
            add(bilinear(layer_.cell(x, y), p.x - static_cast<double>(x), p.y - static_cast<double>(y)));
        }
    }
    [[nodiscard]] bool mixed() const { return limits_ != nullptr && limits_->judge(reach_).mixed(); }

  private:
    void add(double value) { reach_.add(value, 65535 * 8 * shape_.margin); }
    void addInner(const TexelBlock& block) {
        if (block.x1 < block.x0) return;
        TexelRange texels;
        layer_.addBlock(block, texels, mixedTexels());
        reach_.add(texels.lo, 0);
        reach_.add(texels.hi, 0);
    }

    // Where the outline meets the strip y0..y1.
    [[nodiscard]] Span strip(double y0, double y1) const {
        Span span;
        visitStrip(outline_, y0, y1, [&](double x) {
            span.lo = std::min(span.lo, x);
            span.hi = std::max(span.hi, x);
        });
        return span;
    }

    // On an edge the patch of each cell is a parabola: its ends and its vertex.
    void alongEdges() {
        for (unsigned k = 0; k < outline_.count && !mixed(); ++k) {
            const Point<double>&a = outline_.at[k], &b = outline_.next(k);
            walkCells(a, b, 1.0, [&](int64_t x, int64_t y, double from, double to) {
                const auto local = [](double start, double end, double time, int64_t cell) {
                    return std::clamp(start - static_cast<double>(cell) + time * (end - start), 0.0, 1.0);
                };
                addPiece(layer_.cell(x, y), {local(a.x, b.x, from, x), local(a.y, b.y, from, y)},
                         {local(a.x, b.x, to, x), local(a.y, b.y, to, y)});
                return !mixed();
            });
        }
    }
    void addPiece(const CellTexels& t, const Point<double>& from, const Point<double>& to) {
        const double begin = bilinear(t, from.x, from.y);
        const double end = bilinear(t, to.x, to.y);
        add(begin);
        add(end);
        const double bend = (t[0] - t[1] - t[2] + t[3]) * (to.x - from.x) * (to.y - from.y);
        const double slope = end - begin - bend;
        const double vertex = -slope / (2 * bend);
        if (vertex > 0 && vertex < 1) add(begin + vertex * (slope + vertex * bend));
    }

    // Between texel centres on a grid line the patch is linear, so inside the shape the centres are its
    // extremes. Centres within the margin of the outline are left out: alongEdges came that close.
    void insideNodes() {
        const double margin = shape_.margin;
        for (double y = std::ceil(box_.y0); y <= box_.y1 && !mixed(); ++y) {
            const Span low = strip(y - margin, y - margin);
            const Span high = strip(y + margin, y + margin);
            if (!(low.lo <= low.hi && high.lo <= high.hi)) continue;
            const auto row = static_cast<int64_t>(y);
            addInner({ceilInt(std::max(low.lo, high.lo) + margin),
                      floorInt(std::min(low.hi, high.hi) - margin), row, row});
        }
    }

    // The texels that the shape surely touches.
    void insideSquares() {
        const double margin = shape_.margin;
        for (double y = std::floor(box_.y0); y <= box_.y1 && !mixed(); ++y) {
            const Span span = strip(y + margin, y + 1 - margin);
            if (!(span.lo <= span.hi)) continue;
            const auto row = static_cast<int64_t>(y);
            addInner({ceilInt(span.lo - 1 + margin), floorInt(span.hi - margin), row, row});
        }
    }

    const Layer& layer_;
    Filtering filtering_;
    const RoundedShape& shape_;
    const Limits* limits_;
    Box box_;
    Outline<double> outline_;
    Reach reach_;
};

Verdict uniformVerdict(const Limits& limits, const TexelRange& texels) {
    const bool opaque = limits.opaque(texels);
    return {!opaque, opaque, !opaque, opaque};
}

}  // namespace

double spanOf(const RoundedShape& shape) {
    const Box box = boxOf(shape);
    return box.x1 - box.x0 + box.y1 - box.y0;
}

Verdict judgeRounded(const Layer& layer, Filtering filtering, const RoundedShape& shape,
                     const Limits& limits) {
    if (limits.uniform(layer.whole())) return uniformVerdict(limits, layer.whole());
    if (!(spanOf(shape) <= largestSpan)) return Verdict::open();
    Survey survey(layer, filtering, shape, &limits);
    const TexelRange around = survey.boxTexels();
    if (limits.uniform(around)) return uniformVerdict(limits, around);
    survey.outline();
    survey.atCorners();
    if (survey.mixed()) return Verdict::bothSides();
    const TexelRange touched = survey.touchedTexels();
    if (limits.uniform(touched)) return uniformVerdict(limits, touched);
    // The search for touched texels ended early, so they bound nothing: the whole image does.
    return limits.judge(survey.look(filtering == Filtering::nearest ? layer.whole() : TexelRange{0, 65535}));
}

Reach reachOf(const Layer& layer, Filtering filtering, const RoundedShape& shape) {
    Survey survey(layer, filtering, shape, nullptr);
    survey.outline();
    return survey.look(survey.touchedTexels());
}

}  // namespace filigree::verify
