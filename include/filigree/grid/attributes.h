// Vertex attributes and sources in the layout of grids, for shading where a ray hits (Benthin, Vaidyanathan
// and Woop 2021, section 6). Rays do without them.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/vec3.h"
#include "filigree/grid/rays.h"
#include "filigree/grid/vertex_grid.h"
#include "filigree/mesh/uv_triangle.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace filigree::grid {

// All as GridMesh has them; each list may be empty.
struct FILIGREE_API GridAttributes {
    std::vector<Diagonal> diagonals;
    std::vector<std::array<uint32_t, 3>> looseTriangles;  // where there are loose attributes
    std::vector<Vec3> normals;
    std::vector<Vec3> looseNormals;
    std::vector<mesh::Uv> uvs;
    std::vector<mesh::Uv> looseUvs;
    std::vector<std::array<uint32_t, 2>> quadSources;
    std::vector<uint32_t> looseSources;
    bool operator==(const GridAttributes&) const = default;

    [[nodiscard]] bool empty() const {
        return diagonals.empty() && normals.empty() && looseNormals.empty() && uvs.empty() &&
               looseUvs.empty() && quadSources.empty() && looseSources.empty();
    }
    [[nodiscard]] uint64_t bytes() const;
};
FILIGREE_API GridAttributes attributesOf(const GridMesh& mesh);

// Where a ray hit, in the terms of the source.
struct SurfacePoint {
    float gridU = 0;  // across the grid and down, 0..1 (section 5 of the paper); 0 on loose triangles
    float gridV = 0;
    std::optional<uint32_t> source;  // triangle
    std::optional<Vec3> normal;      // not of length 1
    std::optional<mesh::Uv> uv;
};
// `hit` is one on grids of `table` that these attributes belong to.
FILIGREE_API SurfacePoint surfaceAt(const GridAttributes& attributes, std::span<const VertexGrid> table,
                                    const Hit& hit);

// The vertices of the triangle of a quad that `at` names, into GridMesh::vertices: its grid is `grid`.
FILIGREE_API std::array<uint64_t, 3> verticesOf(const GridAttributes& attributes, const VertexGrid& grid,
                                                const Hit& at);

// SurfacePoint::source alone.
FILIGREE_API std::optional<uint32_t> sourceAt(const GridAttributes& attributes,
                                              std::span<const VertexGrid> table, const Hit& hit);

}  // namespace filigree::grid
