// Micro-triangles whose vertex alpha varies: bounds of the product by subdivision.
#pragma once

#include "verify/rounded.h"

namespace filigree::verify {

// A micro-triangle, or a part of one, with the vertex alpha at its corners.
struct ShadedShape {
    RoundedShape shape;
    std::array<double, 3> alphas{};
};

// What is certain of filtered alpha * vertex alpha where the vertex alpha is that of the unwidened point.
// Undecided where the bounds meet the cutoff at the finest subdivision.
Verdict judgeShaded(const Layer& layer, Filtering filtering, const ShadedShape& shaded,
                    const image::AlphaTest& test);

}  // namespace filigree::verify
