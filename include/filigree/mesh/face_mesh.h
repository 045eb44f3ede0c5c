// Triangles and quads over shared vertices, as mesh files hold them.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/result.h"
#include "filigree/core/vec3.h"
#include "filigree/mesh/uv_triangle.h"

#include <array>
#include <cstdint>
#include <vector>

namespace filigree::mesh {

// No vertex at all.
inline constexpr uint32_t noVertex = 0xffffffff;

// Three or four vertices in order around the face; `noVertex` stands fourth in a triangle. A quad is the
// triangles 0 1 2 and 0 2 3.
using Face = std::array<uint32_t, 4>;
constexpr bool isQuad(const Face& face) {
    return face[3] != noVertex;
}

// Source triangles are numbered in the order of the faces, a quad's two one after the other.
struct FILIGREE_API FaceMesh {
    std::vector<Vec3> positions;  // [vertex_count], world units, finite
    std::vector<Face> faces;      // each vertex below vertex_count
    std::vector<Vec3> normals;    // [vertex_count], or empty
    std::vector<Uv> uvs;          // [vertex_count], or empty

    [[nodiscard]] uint64_t triangleCount() const;  // below 2^32
};

// What the comments above promise. The error names the first vertex or face that breaks it.
FILIGREE_API Status check(const FaceMesh& mesh);

}  // namespace filigree::mesh
