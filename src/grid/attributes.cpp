#include "filigree/grid/attributes.h"

namespace filigree::grid {
namespace {

template <class T>
uint64_t bytesIn(const std::vector<T>& list) {
    return list.size() * sizeof(T);
}

// A vertex of a quad, and where it stands in it, or in its grid.
struct QuadCorner {
    uint32_t column = 0;
    uint32_t row = 0;
};
constexpr QuadCorner cornerA{0, 0};
constexpr QuadCorner cornerB{1, 0};
constexpr QuadCorner cornerC{1, 1};
constexpr QuadCorner cornerD{0, 1};

std::array<QuadCorner, 3> cornersOf(Diagonal diagonal, unsigned half) {
    if (diagonal == Diagonal::ac)
        return half == 0 ? std::array{cornerA, cornerB, cornerC} : std::array{cornerA, cornerC, cornerD};
    return half == 0 ? std::array{cornerA, cornerB, cornerD} : std::array{cornerB, cornerC, cornerD};
}

Vec3 blended(const std::array<Vec3, 3>& values, const std::array<float, 3>& weights) {
    return plus(plus(times(values[0], weights[0]), times(values[1], weights[1])),
                times(values[2], weights[2]));
}

mesh::Uv blended(const std::array<mesh::Uv, 3>& values, const std::array<float, 3>& weights) {
    return {values[0].u * weights[0] + values[1].u * weights[1] + values[2].u * weights[2],
            values[0].v * weights[0] + values[1].v * weights[1] + values[2].v * weights[2]};
}

// The blend of the values at three places, where there are any.
template <class T, class Index>
std::optional<T> blendedAt(const std::vector<T>& values, const std::array<Index, 3>& at,
                           const std::array<float, 3>& weights) {
    if (values.empty()) return std::nullopt;
    return blended(std::array{values[at[0]], values[at[1]], values[at[2]]}, weights);
}

SurfacePoint loosePoint(const GridAttributes& attributes, uint32_t triangle,
                        const std::array<float, 3>& weights) {
    SurfacePoint point;
    if (attributes.looseTriangles.empty()) return point;
    const auto& corners = attributes.looseTriangles[triangle];
    point.normal = blendedAt(attributes.looseNormals, corners, weights);
    point.uv = blendedAt(attributes.looseUvs, corners, weights);
    return point;
}

uint64_t quadOf(const VertexGrid& grid, const Hit& hit) {
    return grid.firstQuad + uint64_t{hit.row} * (grid.columns - 1) + hit.column;
}

// The places of a triangle's vertices in its grid.
std::array<QuadCorner, 3> cornersAt(const GridAttributes& attributes, const VertexGrid& grid, const Hit& at) {
    const Diagonal diagonal =
        attributes.diagonals.empty() ? Diagonal::ac : attributes.diagonals[quadOf(grid, at)];
    auto corners = cornersOf(diagonal, at.half);
    for (QuadCorner& corner : corners) corner = {at.column + corner.column, at.row + corner.row};
    return corners;
}

}  // namespace

uint64_t GridAttributes::bytes() const {
    return (diagonals.size() + 7) / 8 + bytesIn(looseTriangles) + bytesIn(normals) + bytesIn(looseNormals) +
           bytesIn(uvs) + bytesIn(looseUvs) + bytesIn(quadSources) + bytesIn(looseSources);
}

GridAttributes attributesOf(const GridMesh& mesh) {
    GridAttributes attributes;
    attributes.normals = mesh.normals;
    attributes.looseNormals = mesh.looseNormals;
    attributes.uvs = mesh.uvs;
    attributes.looseUvs = mesh.looseUvs;
    attributes.quadSources = mesh.quadSources;
    attributes.looseSources = mesh.looseSources;
    attributes.diagonals = mesh.diagonals;
    if (!attributes.looseNormals.empty() || !attributes.looseUvs.empty())
        attributes.looseTriangles = mesh.looseTriangles;
    return attributes;
}

std::optional<uint32_t> sourceAt(const GridAttributes& attributes, std::span<const VertexGrid> table,
                                 const Hit& hit) {
    if (hit.grid == looseGrid) {
        if (attributes.looseSources.empty()) return std::nullopt;
        return attributes.looseSources[hit.column];
    }
    const uint64_t quad = quadOf(table[hit.grid], hit);
    if (attributes.quadSources.empty()) return static_cast<uint32_t>(2 * quad + hit.half);
    return attributes.quadSources[quad][hit.half];
}

std::array<uint64_t, 3> verticesOf(const GridAttributes& attributes, const VertexGrid& grid, const Hit& at) {
    std::array<uint64_t, 3> vertices{};
    const auto corners = cornersAt(attributes, grid, at);
    for (size_t k = 0; k < 3; ++k)
        vertices[k] = grid.firstVertex + uint64_t{corners[k].row} * grid.columns + corners[k].column;
    return vertices;
}

SurfacePoint surfaceAt(const GridAttributes& attributes, std::span<const VertexGrid> table, const Hit& hit) {
    const std::array<float, 3> weights{1 - hit.u - hit.v, hit.u, hit.v};
    if (hit.grid == looseGrid) {
        SurfacePoint point = loosePoint(attributes, hit.column, weights);
        point.source = sourceAt(attributes, table, hit);
        return point;
    }
    const VertexGrid& grid = table[hit.grid];
    const auto corners = cornersAt(attributes, grid, hit);
    SurfacePoint point;
    for (size_t k = 0; k < 3; ++k) {
        point.gridU +=
            weights[k] * static_cast<float>(corners[k].column) / static_cast<float>(grid.columns - 1);
        point.gridV += weights[k] * static_cast<float>(corners[k].row) / static_cast<float>(grid.rows - 1);
    }
    const auto vertices = verticesOf(attributes, grid, hit);
    point.source = sourceAt(attributes, table, hit);
    point.normal = blendedAt(attributes.normals, vertices, weights);
    point.uv = blendedAt(attributes.uvs, vertices, weights);
    return point;
}

}  // namespace filigree::grid
