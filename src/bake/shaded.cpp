#include "bake/shaded.h"

#include "filigree/micromap/quadtree_writer.h"

#include "bake/majority.h"
#include "bake/micro_polygon.h"
#include "bake/rows.h"

#include <algorithm>
#include <cmath>

namespace filigree::bake {
namespace {

// A range of real alphas, 0..1.
struct AlphaRange {
    double least = 1;
    double most = 0;
    void add(double low, double high) {
        least = std::min(least, low);
        most = std::max(most, high);
    }
};

// Both bounds must clear the cutoff by this much of it: shaders multiply in single precision.
constexpr double singleSlack = 1.0 / (1 << 20);

// The state that a range of final alphas proves, or -1.
int provenState(const AlphaRange& alpha, const image::AlphaTest& test) {
    if (test.mode == image::AlphaMode::blend) {
        if (alpha.least >= 1) return 1;
        return alpha.most <= 0 ? 0 : -1;
    }
    const bool exactlyOne = alpha.least >= 1 && test.cutoff <= 1;
    if (exactlyOne || alpha.least >= test.cutoff * (1 + singleSlack)) return 1;
    const bool exactlyZero = alpha.most <= 0 && test.cutoff > 0;
    return exactlyZero || alpha.most < test.cutoff * (1 - singleSlack) ? 0 : -1;
}

class ShadedClassifier {
  public:
    ShadedClassifier(const mesh::UvTriangle& triangle, const ShadedField& field, bool twoState)
        : field_(field), twoState_(twoState) {
        for (size_t k = 0; k < 3; ++k) alpha_[k] = std::max(0.0, double{triangle.alpha[k]});
        for (const ShadedField::Layer& layer : field.layers()) {
            const image::AlphaImage& image = layer.texture->image;
            placements_.emplace_back(triangle, image::CellAxis(image.width, layer.texture->wrapU),
                                     image::CellAxis(image.height, layer.texture->wrapV));
        }
    }

    int visit(const SubTriangle& part, Classified& to) const {
        if (const int state = provenState(roughRange(part), field_.test()); state >= 0)
            return leaf(part, state, to);
        if (part.height > 0) {
            return micromap::appendInner(to.stream, part.height,
                                         [&](unsigned k) { return visit(part.child(k), to); });
        }
        if (const int state = provenState(exactRange(part), field_.test()); state >= 0)
            return leaf(part, state, to);
        return leaf(part, isOpaqueSide(part) ? 3 : 2, to);
    }

  private:
    int leaf(const SubTriangle& part, int state, Classified& to) const {
        return to.appendLeaf(part.height, twoState_ ? state & 1 : state);
    }

    // Vertex alpha times the factor at a lattice point of the whole triangle.
    [[nodiscard]] double vertexAlpha(double i, double j, unsigned level) const {
        const double scale = 1.0 / static_cast<double>(1u << level);
        return field_.test().factor *
               (alpha_[0] + i * scale * (alpha_[1] - alpha_[0]) + j * scale * (alpha_[2] - alpha_[0]));
    }

    // The range over the whole part, rounding included. Equal corners lose nothing.
    [[nodiscard]] AlphaRange vertexRange(const SubTriangle& part) const {
        AlphaRange range{2, 0};
        for (const micromap::LatticePoint& p : part.corner) {
            const double alpha = vertexAlpha(p.i, p.j, part.level);
            range.add(alpha * (1 - 1e-14), alpha * (1 + 1e-14));
        }
        const double least = std::min({alpha_[0], alpha_[1], alpha_[2]}) * field_.test().factor;
        const double most = std::max({alpha_[0], alpha_[1], alpha_[2]}) * field_.test().factor;
        return {std::max(range.least, least), std::min(range.most, most)};
    }

    // Bounds the final alpha by the texels around the part's box.
    [[nodiscard]] AlphaRange roughRange(const SubTriangle& part) const {
        const AlphaRange vertex = vertexRange(part);
        AlphaRange range;
        for (size_t k = 0; k < placements_.size(); ++k) {
            const auto p = part.corners(placements_[k]);
            const double margin = field_.test().guard + 2 * placements_[k].slack() + 1e-12;
            // Nearest filtering reads texels up to half a texel away, bilinear up to one.
            const auto low = [&](double a, double b, double c) {
                return floorToInt(std::min({a, b, c}) - margin);
            };
            const auto high = [&](double a, double b, double c) {
                return floorToInt(std::max({a, b, c}) + margin) + 1;
            };
            const image::TexelRange texels =
                field_.layers()[k].extremes.over(low(p[0].x, p[1].x, p[2].x), high(p[0].x, p[1].x, p[2].x),
                                                 low(p[0].y, p[1].y, p[2].y), high(p[0].y, p[1].y, p[2].y));
            range.add(texels.least / 65535.0 * vertex.least, texels.most / 65535.0 * vertex.most);
        }
        return range;
    }

    // Bounds the final alpha of one micro-triangle by the exact range of the texture's.
    [[nodiscard]] AlphaRange exactRange(const SubTriangle& part) const {
        const AlphaRange vertex = vertexRange(part);
        AlphaRange range;
        for (size_t k = 0; k < placements_.size(); ++k) {
            addLayer(part, k, vertex, range);
            if (isUndecided(range)) return range;
        }
        return range;
    }

    [[nodiscard]] bool isUndecided(const AlphaRange& range) const {
        return provenState(range, field_.test()) < 0;
    }

    // Adds the final alphas of one layer, cell by cell, until it is clear that they are not all on one side.
    void addLayer(const SubTriangle& part, size_t k, const AlphaRange& vertex, AlphaRange& range) const {
        const ShadedField::Layer& layer = field_.layers()[k];
        const auto corners = part.corners(placements_[k]);
        const TriangleRows rows(corners, field_.test().guard + 2 * placements_[k].slack() + 1e-12);
        const WidenedShape shape(corners, field_.test().guard);
        for (int64_t row = rows.firstRow(); row <= rows.lastRow(); ++row) {
            const TriangleRows::Columns columns = rows.columns(row, row);
            if (addTexels(layer, columns.first, columns.last + 1, row, vertex, range)) continue;
            for (int64_t column = columns.first; column <= columns.last; ++column) {
                if (addTexels(layer, column, column + 1, row, vertex, range)) continue;
                const auto polygon = shape.polygon<Bounded>(part, placements_[k], {0, 0, false}, column, row);
                const image::PatchRange values = rangeIn(polygon, *layer.texture, column, row);
                if (values.empty()) continue;
                range.add(std::max(0.0, values.lower) / 65535 * (1 - 1e-14) * vertex.least,
                          std::min(65535.0, values.upper) / 65535 * (1 + 1e-14) * vertex.most);
                if (isUndecided(range)) return;
            }
        }
    }

    // Adds the texels [x0, x1] of rows y and y + 1 where they leave no doubt; else adds nothing and returns
    // false.
    bool addTexels(const ShadedField::Layer& layer, int64_t x0, int64_t x1, int64_t y,
                   const AlphaRange& vertex, AlphaRange& range) const {
        const image::TexelRange texels = layer.extremes.over(x0, x1, y, y + 1);
        AlphaRange both = range;
        both.add(texels.least / 65535.0 * vertex.least, texels.most / 65535.0 * vertex.most);
        if (isUndecided(both)) return false;
        range = both;
        return true;
    }

    // The values of a texture on the part of a polygon in the cell (x, y), in texel units.
    static image::PatchRange rangeIn(const image::PatchPolygon<Bounded>& polygon,
                                     const image::AlphaTexture& texture, int64_t x, int64_t y) {
        const image::AlphaImage& image = texture.image;
        const auto texel = [&](int64_t tx, int64_t ty) {
            return static_cast<double>(image.at(image::wrapTexel(tx, image.width, texture.wrapU),
                                                image::wrapTexel(ty, image.height, texture.wrapV)));
        };
        image::PatchRange range;
        if (texture.filter != image::Filter::nearest) {
            const image::Patch patch =
                image::Patch::of(texel(x, y), texel(x + 1, y), texel(x, y + 1), texel(x + 1, y + 1), 0);
            range = image::rangeOver(patch, polygon);
        }
        if (texture.filter == image::Filter::linear) return range;
        // A quarter of the cell belongs to each texel's square.
        for (const int64_t dx : {0, 1}) {
            for (const int64_t dy : {0, 1}) {
                const double left = 0.5 * static_cast<double>(dx);
                const double low = 0.5 * static_cast<double>(dy);
                const auto touched = image::clipped(polygon, left, left + 0.5, low, low + 0.5);
                if (touched.size() > 0) range.add(texel(x + dx, y + dy));
            }
        }
        return range;
    }

    // The side that more of the centroids of the micro-triangle's parts are on (SideRule).
    [[nodiscard]] bool isOpaqueSide(const SubTriangle& part) const {
        const image::AlphaTest& test = field_.test();
        const double cutoff = test.mode == image::AlphaMode::blend ? 0.5 : test.cutoff;
        const image::AlphaTexture& texture = *field_.layers().front().texture;
        const auto p = part.corners(placements_.front());
        const double area =
            std::fabs((p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x)) / 2;
        const unsigned depth = SideRule::depth(area);
        size_t opaque = 0;
        const std::vector<SideRule::Centroid>& centroids = SideRule::centroids(depth);
        for (const SideRule::Centroid& c : centroids) {
            const double x = p[0].x + c.i * (p[1].x - p[0].x) + c.j * (p[2].x - p[0].x) + 0.5;
            const double y = p[0].y + c.i * (p[1].y - p[0].y) + c.j * (p[2].y - p[0].y) + 0.5;
            const double alpha = texture.filter == image::Filter::nearest
                                     ? image::sampleNearest(texture, x, y)
                                     : image::sampleBilinear(texture, x, y);
            const auto mix = [&](double a, double b, double d) { return a + c.i * (b - a) + c.j * (d - a); };
            const double i = mix(part.corner[0].i, part.corner[1].i, part.corner[2].i);
            const double j = mix(part.corner[0].j, part.corner[1].j, part.corner[2].j);
            opaque += alpha * vertexAlpha(i, j, part.level) >= cutoff ? 1 : 0;
        }
        return 2 * opaque >= centroids.size();
    }

    const ShadedField& field_;
    bool twoState_;
    std::array<double, 3> alpha_;
    std::vector<Placement> placements_;  // one a layer
};

}  // namespace

ShadedField::ShadedField(const image::MipChain& chain, const image::AlphaTest& test) : test_(test) {
    for (const image::AlphaTexture* level : chain.levels()) {
        layers_.push_back({level, image::TexelExtremes(*level)});
    }
}

void classifyShaded(const mesh::UvTriangle& triangle, const ShadedField& field, unsigned level, bool twoState,
                    Classified& to) {
    ShadedClassifier(triangle, field, twoState).visit(SubTriangle::whole(level), to);
}

}  // namespace filigree::bake
