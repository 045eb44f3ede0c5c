#include "verify/limits.h"

#include <algorithm>
#include <cmath>

namespace filigree::verify {
namespace {

constexpr uint32_t fullTexel = 65535;

bool isAbove(const Threshold& t, uint32_t texel) {
    const Big value = t.scale * texel;
    return t.strict ? value > t.bound : value >= t.bound;
}

// Fills the members that follow from scale, bound and strict; `estimate` is bound / scale or anything near
// it.
Threshold finished(Threshold t, double estimate) {
    uint32_t below = 0;
    uint32_t above = fullTexel + 1;
    while (below < above) {
        const uint32_t middle = (below + above) / 2;
        if (isAbove(t, middle)) {
            above = middle;
        } else {
            below = middle + 1;
        }
    }
    t.texel = above;
    const double last = static_cast<double>(above);
    t.value = std::isnan(estimate) ? last : std::clamp(estimate, last - 1, last);
    t.slack = std::isnan(estimate) ? 1 : std::abs(t.value) * 0x1p-48;
    return t;
}

// scale * f against bound, both exact: scale = factor * alpha, bound = limit * 65535.
Threshold scaledThreshold(double factor, float alpha, double limit, bool strict) {
    const int factorShift = std::max(0, -lowestBit(factor));
    const int alphaShift = std::max(0, -lowestBit(double{alpha}));
    const int shift = std::max(factorShift + alphaShift, -lowestBit(limit));
    Threshold t;
    t.scale = scaled(factor, shift - alphaShift) * scaled(double{alpha}, alphaShift);
    t.bound = scaled(limit, shift) * fullTexel;
    t.strict = strict;
    const double product = factor * double{alpha};
    const bool precise = product > std::numeric_limits<double>::min();
    return finished(t, precise ? limit * fullTexel / product : std::numeric_limits<double>::quiet_NaN());
}

Threshold texelThreshold(uint32_t texel, bool strict) {
    Threshold t;
    t.scale = 1;
    t.bound = texel;
    t.strict = strict;
    return finished(t, texel);
}

// Whether a shader may come to see `texel` as opaque, in single or double precision.
bool opaqueInFloat(const image::AlphaTest& test, float alpha, uint32_t texel) {
    const float value = static_cast<float>(texel) / 65535.0F * static_cast<float>(test.factor) * alpha;
    return value >= static_cast<float>(test.cutoff);
}
bool opaqueInDouble(const image::AlphaTest& test, float alpha, uint32_t texel) {
    return static_cast<double>(texel) / 65535.0 * test.factor * double{alpha} >= test.cutoff;
}

Limits maskLimits(const image::AlphaTest& test, float alpha) {
    Limits limits;
    limits.low = limits.high = scaledThreshold(test.factor, alpha, test.cutoff, false);
    const Threshold exact = limits.low;
    // Rounding moves a texel by far less than one step, so only the nearest one can be in doubt.
    const uint32_t nearest = exact.texel > 0 && static_cast<double>(exact.texel) - exact.value > 0.5
                                 ? exact.texel - 1
                                 : exact.texel;
    if (nearest > fullTexel) return limits;
    const bool above = nearest >= exact.texel;
    if (opaqueInFloat(test, alpha, nearest) == above && opaqueInDouble(test, alpha, nearest) == above)
        return limits;
    if (above) {
        limits.high = texelThreshold(nearest, true);
    } else {
        limits.low = texelThreshold(nearest, false);
    }
    return limits;
}

}  // namespace

int lowestBit(double value) {
    if (value == 0) return 0;
    int exponent = 0;
    auto mantissa = static_cast<int64_t>(std::ldexp(std::frexp(value, &exponent), 53));
    exponent -= 53;
    for (; (mantissa & 1) == 0; mantissa /= 2) ++exponent;
    return exponent;
}

Big scaled(double value, int shift) {
    const int lowest = lowestBit(value);
    return Big(static_cast<int64_t>(std::ldexp(value, -lowest))) << static_cast<unsigned>(lowest + shift);
}

Verdict Limits::judge(const Reach& reach) const {
    if (reach.outerLo > reach.outerHi) return Verdict::open();
    Verdict verdict;
    verdict.maybeNotOpaque = !high.above(reach.outerLo);
    verdict.maybeNotTransparent = !low.below(reach.outerHi);
    verdict.notOpaque = surelyNotOpaque().below(reach.innerLo) || !verdict.maybeNotTransparent;
    verdict.notTransparent = surelyNotTransparent().above(reach.innerHi) || !verdict.maybeNotOpaque;
    return verdict;
}

Limits makeLimits(const image::AlphaTest& test, float alpha) {
    if (test.mode == image::AlphaMode::mask) return maskLimits(test, alpha);
    Limits limits;
    limits.blend = true;
    limits.low = scaledThreshold(test.factor, alpha, 0, true);
    limits.high = scaledThreshold(test.factor, alpha, 1, false);
    return limits;
}

}  // namespace filigree::verify
