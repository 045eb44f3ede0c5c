// A mesh as the growth of grids sees it: triangles over welded vertices, and who borders on whom.
#pragma once

#include "filigree/mesh/face_mesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace filigree::grid {

inline constexpr uint32_t noEdge = 0xffffffff;
inline constexpr uint8_t noCorner = 3;

// Half-edge 3 t + k of triangle t runs from its vertex k to the next one.
struct Topology {
    std::vector<std::array<uint32_t, 3>> triangles;  // vertices of the mesh, one for all that are equal
    std::vector<uint32_t> twins;                     // [3 * triangle_count], noEdge at borders
    std::vector<uint8_t> diagonal;  // [triangle_count], the edge inside a quad of the mesh, or noCorner

    [[nodiscard]] uint32_t from(uint32_t edge) const { return triangles[edge / 3][edge % 3]; }
    [[nodiscard]] bool hasThreeVertices(uint32_t triangle) const {
        const auto& [a, b, c] = triangles[triangle];
        return a != b && b != c && c != a;
    }
};

constexpr uint32_t nextEdge(uint32_t edge) {
    return edge % 3 == 2 ? edge - 2 : edge + 1;
}
constexpr uint32_t previousEdge(uint32_t edge) {
    return edge % 3 == 0 ? edge + 2 : edge - 1;
}

// With `attributes`, vertices that differ in normal or texture coordinates are two. Twins are half-edges that
// are alone between their two vertices in either direction. Of triangles with the same three vertices each
// belongs to a sheet of its own, within which twins are sought, so that surfaces with a back of their own
// hold together.
Topology topologyOf(const mesh::FaceMesh& mesh, bool attributes);

}  // namespace filigree::grid
