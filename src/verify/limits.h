// What values count as opaque and transparent for one alpha test and one vertex alpha, in units of a texel
// step (1/65535), exactly.
#pragma once

#include "filigree/image/alpha_image.h"

#include "verify/arithmetic.h"
#include "verify/layer.h"

#include <cstdint>
#include <limits>

namespace filigree::verify {

// A border between lower and higher filtered texels f: f is above it when scale * f >= bound (> when strict).
struct Threshold {
    Big scale;  // >= 0
    Big bound;
    bool strict = false;
    uint32_t texel = 0;  // the least texel above it; 65536 when there is none
    double value = 0;    // bound / scale, rounded, in [texel - 1, texel]
    double slack = 0;    // of `value`

    // Whether any real f >= value is above, below for f <= value; false where rounding cannot tell.
    [[nodiscard]] bool above(double f) const { return f >= static_cast<double>(texel) || f > value + slack; }
    [[nodiscard]] bool below(double f) const {
        return f <= static_cast<double>(texel) - 1 || f < value - slack;
    }
    bool operator==(const Threshold& other) const {
        return scale == other.scale && bound == other.bound && strict == other.strict;
    }
};

// What is certain of the values that filters give on a shape. Outer bounds hold them all; a value <= innerLo
// and one
// >= innerHi do occur.
struct Reach {
    double innerLo = std::numeric_limits<double>::infinity();
    double innerHi = -std::numeric_limits<double>::infinity();
    double outerLo = std::numeric_limits<double>::infinity();
    double outerHi = -std::numeric_limits<double>::infinity();

    // A value within `error` of `value` occurs.
    void add(double value, double error) {
        innerLo = std::min(innerLo, value + error);
        innerHi = std::max(innerHi, value - error);
        outerLo = std::min(outerLo, value - error);
        outerHi = std::max(outerHi, value + error);
    }
};

// What is certain of a micro-triangle, gathered over points, filters and mip levels.
struct Verdict {
    bool notOpaque = false;       // a point is not opaque, for sure
    bool notTransparent = false;  // a point is not transparent, for sure
    bool maybeNotOpaque = false;  // a point may be not opaque
    bool maybeNotTransparent = false;

    [[nodiscard]] bool mixed() const { return notOpaque && notTransparent; }
    [[nodiscard]] bool decided() const { return mixed() || !maybeNotOpaque || !maybeNotTransparent; }
    void add(const Verdict& other) {
        notOpaque |= other.notOpaque;
        notTransparent |= other.notTransparent;
        maybeNotOpaque |= other.maybeNotOpaque;
        maybeNotTransparent |= other.maybeNotTransparent;
    }
    // Nothing is known.
    static Verdict open() { return {false, false, true, true}; }
    // Both sides occur, or are to be treated so.
    static Verdict bothSides() { return {true, true, true, true}; }
};

// Two thresholds: all above `high` is opaque, all below `low` transparent. Under a mask they are the cutoff;
// they differ where a texel sits on the cutoff so closely that float and exact arithmetic disagree about it,
// and what lies between is uncertain. Under blend they are the ends of the scale, and what lies between is
// neither.
struct Limits {
    Threshold low;
    Threshold high;
    bool blend = false;

    [[nodiscard]] const Threshold& surelyNotOpaque() const { return blend ? high : low; }
    [[nodiscard]] const Threshold& surelyNotTransparent() const { return blend ? low : high; }

    [[nodiscard]] bool opaque(const TexelRange& texels) const { return texels.lo >= high.texel; }
    [[nodiscard]] bool transparent(const TexelRange& texels) const { return texels.hi < low.texel; }
    [[nodiscard]] bool uniform(const TexelRange& texels) const {
        return opaque(texels) || transparent(texels);
    }
    [[nodiscard]] Verdict judge(const Reach& reach) const;
};

// The limits of `test` where the vertex alpha is `alpha` throughout, finite and >= 0.
Limits makeLimits(const image::AlphaTest& test, float alpha);

}  // namespace filigree::verify
