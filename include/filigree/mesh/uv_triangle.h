// A triangle as an opacity micromap sees it.
#pragma once

#include "filigree/core/api.h"

#include <array>

namespace filigree::mesh {

// A texture coordinate.
struct Uv {
    float u = 0;
    float v = 0;
    bool operator==(const Uv&) const = default;
};

// Texture coordinates of a triangle's three vertices in index order, and the vertices' own alpha (COLOR_0.a),
// which multiplies the texture's and is interpolated linearly.
struct UvTriangle {
    std::array<Uv, 3> uv;
    std::array<float, 3> alpha{1, 1, 1};  // in [0, 1]
};

// True when no texture coordinate is NaN or infinite.
FILIGREE_API bool isFinite(const UvTriangle& triangle);

}  // namespace filigree::mesh
