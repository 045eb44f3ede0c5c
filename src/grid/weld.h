// Vertices that are equal.
#pragma once

#include "filigree/core/vec3.h"
#include "filigree/mesh/uv_triangle.h"

#include <cstdint>
#include <span>
#include <vector>

namespace filigree::grid {

struct WeldInput {
    std::span<const Vec3> positions;  // [vertex_count], below 2^32
    std::span<const Vec3> normals;    // [vertex_count], or empty
    std::span<const mesh::Uv> uvs;    // [vertex_count], or empty
};

// The first vertex that equals each one in all that is given, to the bit but for the sign of 0:
// [vertex_count].
std::vector<uint32_t> weld(const WeldInput& input);

}  // namespace filigree::grid
