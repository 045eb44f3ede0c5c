// Geometry as vertex grids: what the conversion gives and the codecs take (Benthin, Vaidyanathan and Woop
// 2021, section 3).
#pragma once

#include "filigree/core/vec3.h"
#include "filigree/mesh/uv_triangle.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace filigree::grid {

// A grid of columns x rows vertices, row by row. Vertex (column, row) stands at firstVertex + row * columns +
// column of GridMesh::vertices, quad (column, row) at firstQuad + row * (columns - 1) + column.
struct VertexGrid {
    uint32_t columns = 0;  // vertices, at least 2 and at most 2^16
    uint32_t rows = 0;     // the same
    uint64_t firstVertex = 0;
    uint64_t firstQuad = 0;

    [[nodiscard]] uint64_t vertexCount() const { return uint64_t{columns} * rows; }
    [[nodiscard]] uint64_t quadCount() const { return uint64_t{columns - 1} * (rows - 1); }
    bool operator==(const VertexGrid&) const = default;
};

// The corners of quad (column, row) are a = (column, row), b = (column + 1, row), c = (column + 1, row + 1)
// and d = (column, row + 1). Its diagonal is part of the surface.
enum class Diagonal : uint8_t {
    ac,  // triangles a b c and a c d
    bd,  // triangles a b d and b c d
};

// Every triangle of a mesh: most in grids, the others loose.
struct GridMesh {
    std::vector<Vec3> vertices;     // of all grids, finite, world units
    std::vector<VertexGrid> grids;  // their vertices and quads follow each other without gaps
    // [quad_count], or empty where all are Diagonal::ac.
    std::vector<Diagonal> diagonals;

    std::vector<Vec3> looseVertices;
    std::vector<std::array<uint32_t, 3>> looseTriangles;  // into looseVertices

    // The way back to the source, not needed by rays. The first is [quad_count]: the source triangle of each
    // half of a quad; empty where half k of quad q is source triangle 2 q + k. The second is
    // [loose_triangle_count].
    std::vector<std::array<uint32_t, 2>> quadSources;
    std::vector<uint32_t> looseSources;

    // Attributes in grid layout (section 6): [vertices] and [looseVertices], or empty.
    std::vector<Vec3> normals;
    std::vector<Vec3> looseNormals;
    std::vector<mesh::Uv> uvs;
    std::vector<mesh::Uv> looseUvs;

    [[nodiscard]] uint64_t quadCount() const {
        return grids.empty() ? 0 : grids.back().firstQuad + grids.back().quadCount();
    }
    [[nodiscard]] uint64_t triangleCount() const { return 2 * quadCount() + looseTriangles.size(); }
    [[nodiscard]] Diagonal diagonalOf(uint64_t quad) const {
        return diagonals.empty() ? Diagonal::ac : diagonals[quad];
    }
};

}  // namespace filigree::grid
