#include "verify/vertex_alpha.h"

#include "filigree/micromap/curve.h"

#include <algorithm>

namespace filigree::verify {
namespace {

// Parts of parts are looked at this deep, unless they are larger than this many rows and columns.
constexpr unsigned deepest = 5;
constexpr double largestSubdivided = 4096;

// Products are compared to within single precision, which shaders use.
constexpr double relativeSlack = 0x1p-20;

// Bounds of the product of a part's texels and vertex alphas.
Verdict boundProduct(const Reach& texels, const ShadedShape& part, const image::AlphaTest& test) {
    const auto [least, most] = std::minmax_element(part.alphas.begin(), part.alphas.end());
    const double lo = std::max(texels.outerLo, 0.0) * *least * test.factor;
    const double hi = texels.outerHi * *most * test.factor;
    const double seenLo = texels.innerLo * *most * test.factor;   // a product at most this occurs
    const double seenHi = texels.innerHi * *least * test.factor;  // a product at least this occurs
    Verdict verdict;
    if (test.mode == image::AlphaMode::blend) {
        verdict = {seenLo<65535 * (1 - relativeSlack), seenHi> 0, true, hi > 0};
    } else {
        const double bound = test.cutoff * 65535;
        const double low = bound * (1 - relativeSlack);
        const double high = bound * (1 + relativeSlack);
        verdict = {seenLo < low, seenHi >= high, lo < high, hi >= low};
    }
    verdict.notOpaque |= !verdict.maybeNotTransparent;
    verdict.notTransparent |= !verdict.maybeNotOpaque;
    return verdict;
}

std::array<ShadedShape, 4> quarters(const ShadedShape& whole) {
    struct Corner {
        Point<double> at;
        double alpha;
    };
    std::array<Corner, 3> corners;
    for (size_t k = 0; k < 3; ++k) corners[k] = {whole.shape.corners[k], whole.alphas[k]};
    std::array<ShadedShape, 4> parts;
    for (unsigned child = 0; child < 4; ++child) {
        parts[child].shape = whole.shape;
        const auto at = micromap::childCorners(corners, child, [](const Corner& a, const Corner& b) {
            return Corner{{(a.at.x + b.at.x) / 2, (a.at.y + b.at.y) / 2}, (a.alpha + b.alpha) / 2};
        });
        for (size_t k = 0; k < 3; ++k) {
            parts[child].shape.corners[k] = at[k].at;
            parts[child].alphas[k] = at[k].alpha;
        }
    }
    return parts;
}

Verdict judgePart(const Layer& layer, Filtering filtering, const ShadedShape& part,
                  const image::AlphaTest& test, unsigned depth) {
    const Verdict whole = boundProduct(reachOf(layer, filtering, part.shape), part, test);
    if (whole.decided() || depth == deepest || spanOf(part.shape) > largestSubdivided) return whole;
    Verdict verdict{whole.notOpaque, whole.notTransparent, whole.notOpaque, whole.notTransparent};
    for (const ShadedShape& quarter : quarters(part)) {
        verdict.add(judgePart(layer, filtering, quarter, test, depth + 1));
        if (verdict.mixed()) break;
    }
    return verdict;
}

}  // namespace

Verdict judgeShaded(const Layer& layer, Filtering filtering, const ShadedShape& shaded,
                    const image::AlphaTest& test) {
    if (!(spanOf(shaded.shape) <= largestSpan)) return Verdict::open();
    return judgePart(layer, filtering, shaded, test, 0);
}

}  // namespace filigree::verify
