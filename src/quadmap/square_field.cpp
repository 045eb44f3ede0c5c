#include "quadmap/square_field.h"

#include "filigree/image/placement.h"
#include "filigree/image/widened.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace filigree::quadmap {
namespace {

using image::PatchPoint;
using image::Side;

Region regionOf(Side side) {
    return side == Side::opaque        ? Region::opaque
           : side == Side::transparent ? Region::transparent
                                       : Region::mixed;
}

// Opaque is what lies on the opaque side of `highest`, transparent what lies on the other of `lowest`.
struct Limits {
    image::Threshold lowest;
    image::Threshold highest;
};

// The limits for vertex alphas between `least` and `most`.
Limits limitsOf(const image::AlphaTest& test, double least, double most, uint32_t steps) {
    const auto lower = [](const image::Threshold& a, const image::Threshold& b) { return a.value < b.value; };
    return {std::ranges::min(image::thresholdsOf(test, most, steps), lower),
            std::ranges::max(image::thresholdsOf(test, least, steps), lower)};
}

// A lattice point of the half: vertex 0 is (0, 0), vertices 1 and 2 are (side, 0) and (0, side).
struct LatticePoint {
    int64_t i = 0;
    int64_t j = 0;
};

// The half on one mip level.
class HalfOnLayer {
  public:
    HalfOnLayer(const SquareField::Layer& layer, const HalfShape& shape, unsigned level, double guard)
        : layer_(&layer), placement_(place(layer, shape)), level_(level), guard_(guard) {
        square_ = image::widened(std::array{at({0, 0}), at({1, 0}), at({1, 1}), at({0, 1})}, guard);
        triangle_ = image::widened(std::array{at({0, 0}), at({1, 0}), at({0, 1})}, guard);
    }

    // The side of all regions of a block, by the texels around it.
    [[nodiscard]] Side roughly(const LatticePoint& first, int64_t size, const Limits& limits) const {
        image::PatchRange x;
        image::PatchRange y;
        for (const int64_t i : {first.i, first.i + size}) {
            for (const int64_t j : {first.j, first.j + size}) {
                x.add(at({i, j}).x);
                y.add(at({i, j}).y);
            }
        }
        const double margin = guard_ + 8 * placement_.slack();
        const auto cell = [](double v) { return static_cast<int64_t>(std::floor(v)); };
        return between(limits, [&](const image::Threshold& threshold) {
            return layer_->sides.roughly(cell(x.lower - margin), cell(x.upper + margin),
                                         cell(y.lower - margin), cell(y.upper + margin), threshold);
        });
    }

    // The side of one region, or of the half's part of one on the diagonal.
    [[nodiscard]] Side exactly(const LatticePoint& first, bool diagonal, const Limits& limits) const {
        const auto polygon = diagonal ? polygonOf(triangle_, {{{0, 0}, {1, 0}, {0, 1}}}, first)
                                      : polygonOf(square_, {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}, first);
        return between(limits, [&](const image::Threshold& threshold) {
            Side all = layer_->sides.over(polygon, layer_->filters.front(), threshold);
            if (layer_->filters.size() > 1 &&
                all != layer_->sides.over(polygon, layer_->filters[1], threshold))
                all = Side::mixed;
            return all;
        });
    }

    [[nodiscard]] uint32_t steps() const { return layer_->sides.texture().image.steps; }

  private:
    static image::Placement place(const SquareField::Layer& layer, const HalfShape& shape) {
        const image::AlphaTexture& texture = layer.sides.texture();
        const image::CellAxis axisX(texture.image.width, texture.wrapU);
        const image::CellAxis axisY(texture.image.height, texture.wrapV);
        std::array<PatchPoint<Bounded>, 3> corners;
        for (size_t k = 0; k < 3; ++k) {
            corners[k] = {Bounded(shape.x[k]) * Bounded(axisX.size) / Bounded(shape.width),
                          Bounded(shape.y[k]) * Bounded(axisY.size) / Bounded(shape.height)};
        }
        return {corners, axisX, axisY};
    }

    // Asks for the side under both limits.
    template <class Ask>
    static Side between(const Limits& limits, Ask ask) {
        const Side high = ask(limits.highest);
        if (high == Side::opaque || limits.lowest == limits.highest) return high;
        return ask(limits.lowest) == Side::transparent ? Side::transparent : Side::mixed;
    }

    [[nodiscard]] PatchPoint<double> at(const LatticePoint& p) const {
        return placement_.at(p.i, p.j, level_);
    }

    [[nodiscard]] image::PatchPolygon<Bounded> polygonOf(const std::vector<image::WidenedCorner>& shape,
                                                         const std::array<LatticePoint, 4>& corners,
                                                         const LatticePoint& first) const {
        image::PatchPolygon<Bounded> polygon;
        for (const image::WidenedCorner& c : shape) {
            const LatticePoint& p = corners[c.corner];
            const PatchPoint<Bounded> at = placement_.boundedAt(first.i + p.i, first.j + p.j, level_);
            polygon.push({at.x + Bounded(c.x), at.y + Bounded(c.y)});
        }
        return polygon;
    }

    const SquareField::Layer* layer_;
    image::Placement placement_;
    unsigned level_;
    double guard_;
    std::vector<image::WidenedCorner> square_;
    std::vector<image::WidenedCorner> triangle_;
};

// Fills one half, block by block where the texels leave no doubt.
class HalfFill {
  public:
    HalfFill(const SquareField& field, const HalfShape& shape, Half half, Square& square)
        : field_(field), shape_(shape), half_(half), square_(square) {
        const auto level = static_cast<unsigned>(std::countr_zero(square.side));
        for (const SquareField::Layer& layer : field.layers())
            layers_.emplace_back(layer, shape, level, field.test().guard);
        if (isShaded()) return;
        for (const HalfOnLayer& layer : layers_)
            limits_.push_back(limitsOf(field.test(), shape.alpha[0], shape.alpha[0], layer.steps()));
    }

    void visit(const LatticePoint& first, int64_t size) {
        const int64_t diagonal = square_.side - 1;
        if (first.i + first.j > diagonal) return;
        const std::vector<Limits> limits = isShaded() ? limitsIn(first, size) : limits_;
        const Side rough = ofAllLayers([&](size_t k) { return layers_[k].roughly(first, size, limits[k]); });
        if (rough != Side::mixed) return write(first, size, regionOf(rough));
        if (size == 1) {
            const bool cut = first.i + first.j == diagonal;
            return write(
                first, 1,
                regionOf(ofAllLayers([&](size_t k) { return layers_[k].exactly(first, cut, limits[k]); })));
        }
        const int64_t part = size / 2;
        for (const int64_t j : {first.j, first.j + part}) {
            for (const int64_t i : {first.i, first.i + part}) visit({i, j}, part);
        }
    }

    void write(const LatticePoint& first, int64_t size, Region region) {
        const int64_t last = square_.side - 1;
        for (int64_t j = first.j; j < first.j + size; ++j) {
            for (int64_t i = first.i; i < first.i + size && i + j <= last; ++i) {
                const auto x = static_cast<unsigned>(half_ == Half::first ? i : last - i);
                const auto y = static_cast<unsigned>(half_ == Half::first ? j : last - j);
                square_.at(x, y) = agreed(square_.at(x, y), region);
            }
        }
    }

  private:
    [[nodiscard]] bool isShaded() const {
        return shape_.alpha[0] != shape_.alpha[1] || shape_.alpha[0] != shape_.alpha[2];
    }

    template <class Ask>
    Side ofAllLayers(Ask ask) const {
        const Side side = ask(size_t{0});
        for (size_t k = 1; k < layers_.size() && side != Side::mixed; ++k) {
            if (ask(k) != side) return Side::mixed;
        }
        return side;
    }

    // The limits for the vertex alphas of a block, whose corners may lie beyond the half, with 2^-20 of them
    // to spare: shaders interpolate in single precision.
    [[nodiscard]] std::vector<Limits> limitsIn(const LatticePoint& first, int64_t size) const {
        image::PatchRange alpha;
        const double n = square_.side;
        for (const int64_t i : {first.i, first.i + size}) {
            for (const int64_t j : {first.j, first.j + size}) {
                const double a = static_cast<double>(i) / n;
                const double b = static_cast<double>(j) / n;
                alpha.add(shape_.alpha[0] + a * (shape_.alpha[1] - shape_.alpha[0]) +
                          b * (shape_.alpha[2] - shape_.alpha[0]));
            }
        }
        const auto [least, most] = std::minmax({shape_.alpha[0], shape_.alpha[1], shape_.alpha[2]});
        const double lower = std::max(alpha.lower * (1 - spare), least * (1 - spare));
        const double upper = std::min(alpha.upper * (1 + spare), most * (1 + spare));
        std::vector<Limits> limits;
        for (const HalfOnLayer& layer : layers_)
            limits.push_back(limitsOf(field_.test(), lower, upper, layer.steps()));
        return limits;
    }

    static constexpr double spare = 1.0 / (1 << 20);

    const SquareField& field_;
    const HalfShape& shape_;
    Half half_;
    Square& square_;
    std::vector<HalfOnLayer> layers_;
    std::vector<Limits> limits_;  // by layer, for a constant vertex alpha
};

}  // namespace

SquareField::SquareField(const image::AlphaTexture& texture, const image::AlphaTest& test)
    : chain_(texture, test.mips), test_(test) {
    for (const image::AlphaTexture* level : chain_.levels())
        layers_.push_back({image::AlphaSides(*level), image::filtersOf(level->filter)});
}

void SquareField::fill(const HalfShape& shape, Half half, Square& square) const {
    HalfFill(*this, shape, half, square).visit({0, 0}, square.side);
}

}  // namespace filigree::quadmap
