// Triangles that need no work of their own: equal ones are baked once.
#pragma once

#include "filigree/mesh/uv_triangle.h"

#include <cstdint>
#include <span>
#include <vector>

namespace filigree::bake {

struct DistinctTriangles {
    std::vector<uint32_t> representative;  // [distinct_count], a triangle's number
    std::vector<uint32_t> number;          // [triangle_count], into `representative`
};

// Merges triangles with the same corners bit for bit, the same vertex alpha and the same level.
DistinctTriangles findDistinct(std::span<const mesh::UvTriangle> triangles, std::span<const uint8_t> levels);

}  // namespace filigree::bake
