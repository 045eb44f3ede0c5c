#include "verify/judge.h"

#include "verify/exact.h"
#include "verify/vertex_alpha.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace filigree::verify {
namespace {

// Coordinates beyond this many texels are not looked at.
constexpr double farthest = 0x1p40;

// Exact arithmetic on shapes that span more rows and columns would take too long.
constexpr double largestExact = 0x1p16;

bool isUsable(const mesh::UvTriangle& triangle) {
    return mesh::isFinite(triangle) &&
           std::ranges::all_of(triangle.alpha, [](float alpha) { return std::isfinite(alpha); });
}

std::vector<Filtering> filteringsOf(image::Filter filter) {
    switch (filter) {
        case image::Filter::linear:
            return {Filtering::linear};
        case image::Filter::nearest:
            return {Filtering::nearest};
        default:
            return {Filtering::linear, Filtering::nearest};
    }
}

// The corners' mean weights of the triangle's vertices, times 2^level.
std::array<std::array<double, 3>, 3> weightsOf(const micromap::LatticeTriangle& place, unsigned level) {
    const uint32_t n = uint32_t{1} << level;
    std::array<std::array<double, 3>, 3> weights{};
    const auto points = micromap::corners(place);
    for (size_t k = 0; k < 3; ++k) {
        weights[k] = {static_cast<double>(n - points[k].i - points[k].j), static_cast<double>(points[k].i),
                      static_cast<double>(points[k].j)};
    }
    return weights;
}

}  // namespace

TextureJudge::TextureJudge(const image::AlphaTexture& texture, const image::AlphaTest& test)
    : test_(test), filterings_(filteringsOf(texture.filter)), limits_(makeLimits(test, 1)) {
    const image::AlphaImage* image = &texture.image;
    layers_.emplace_back(*image, texture.wrapU, texture.wrapV);
    const unsigned coarser = std::min(test.mips, image::coarserLevels(texture.image));
    for (unsigned level = 0; level < coarser; ++level) {
        image = &coarser_.emplace_back(image::halve(*image));
        layers_.emplace_back(*image, texture.wrapU, texture.wrapV);
    }
}

TriangleJudge::TriangleJudge(const TextureJudge& judge, const mesh::UvTriangle& triangle)
    : judge_(judge), triangle_(triangle) {
    if (!isUsable(triangle)) {
        always_ = Verdict::bothSides();
        return;
    }
    const auto& alpha = triangle.alpha;
    shaded_ = alpha[0] != alpha[1] || alpha[0] != alpha[2];
    if (!shaded_ && alpha[0] != 1) own_ = makeLimits(judge.test(), std::max(alpha[0], 0.0F));
    place();
}

void TriangleJudge::place() {
    for (const Layer& layer : judge_.layers()) {
        Frame frame{};
        double size = judge_.test().guard;
        for (size_t k = 0; k < 3; ++k) {
            frame.vertices[k] = {double{triangle_.uv[k].u} * layer.width(),
                                 double{triangle_.uv[k].v} * layer.height()};
            size = std::max({size, std::abs(frame.vertices[k].x), std::abs(frame.vertices[k].y)});
        }
        if (!(size <= farthest)) always_ = Verdict::open();
        frame.margin = marginFor(size);
        frames_.push_back(frame);
    }
}

RoundedShape TriangleJudge::shape(const Frame& frame, Filtering filtering, unsigned level,
                                  const micromap::LatticeTriangle& place) const {
    RoundedShape result;
    result.guard = judge_.test().guard;
    result.margin = frame.margin;
    const double offset = filtering == Filtering::linear ? 0.5 : 0;
    const double unit = 1.0 / static_cast<double>(uint32_t{1} << level);
    const auto weights = weightsOf(place, level);
    const auto& v = frame.vertices;
    for (size_t k = 0; k < 3; ++k) {
        const auto& w = weights[k];
        result.corners[k].x = (w[0] * v[0].x + w[1] * v[1].x + w[2] * v[2].x) * unit - offset;
        result.corners[k].y = (w[0] * v[0].y + w[1] * v[1].y + w[2] * v[2].y) * unit - offset;
    }
    return result;
}

Verdict TriangleJudge::shadedVerdict(const Layer& layer, Filtering filtering, const RoundedShape& shape,
                                     unsigned level, const micromap::LatticeTriangle& place) const {
    ShadedShape shaded{shape, {}};
    const double unit = 1.0 / static_cast<double>(uint32_t{1} << level);
    const auto weights = weightsOf(place, level);
    for (size_t k = 0; k < 3; ++k) {
        for (size_t w = 0; w < 3; ++w) {
            shaded.alphas[k] += weights[k][w] * unit * std::max(double{triangle_.alpha[w]}, 0.0);
        }
    }
    return judgeShaded(layer, filtering, shaded, judge_.test());
}

Verdict TriangleJudge::verdictOn(size_t layer, Filtering filtering, unsigned level,
                                 const micromap::LatticeTriangle& place) const {
    const Layer& texels = judge_.layers()[layer];
    const RoundedShape rounded = shape(frames_[layer], filtering, level, place);
    if (shaded_) return shadedVerdict(texels, filtering, rounded, level, place);
    const Limits& limits = own_ ? *own_ : judge_.limits();
    const Verdict verdict = judgeRounded(texels, filtering, rounded, limits);
    if (verdict.decided() || spanOf(rounded) > largestExact) return verdict;
    return judgeExactly(texels, filtering, triangle_, level, place, judge_.test().guard, limits);
}

Verdict TriangleJudge::verdict(unsigned level, uint64_t microTriangle) const {
    if (always_) return *always_;
    const auto place = micromap::latticeTriangle(static_cast<uint32_t>(microTriangle), level);
    Verdict verdict;
    for (size_t layer = 0; layer < frames_.size(); ++layer) {
        for (const Filtering filtering : judge_.filterings()) {
            verdict.add(verdictOn(layer, filtering, level, place));
            if (verdict.mixed()) return verdict;
        }
    }
    return verdict;
}

Truth truthOf(const Verdict& verdict) {
    if (!verdict.maybeNotOpaque) return Truth::opaque;
    if (!verdict.maybeNotTransparent) return Truth::transparent;
    return verdict.mixed() ? Truth::mixed : Truth::uncertain;
}

Judge::Judge(const image::AlphaTexture& texture, const image::AlphaTest& test)
    : judge_(std::make_unique<const TextureJudge>(texture, test)) {}

Judge::~Judge() = default;

Truth Judge::truth(const mesh::UvTriangle& triangle, unsigned level, uint64_t microTriangle) const {
    assert(level <= micromap::maxLevel && microTriangle < micromap::microTriangleCount(level));
    return truthOf(TriangleJudge(*judge_, triangle).verdict(level, microTriangle));
}

Truth truthOf(const mesh::UvTriangle& triangle, unsigned level, uint64_t microTriangle,
              const image::AlphaTexture& texture, const image::AlphaTest& test) {
    return Judge(texture, test).truth(triangle, level, microTriangle);
}

}  // namespace filigree::verify
