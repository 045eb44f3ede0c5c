#include "filigree/grid/attributes.h"

namespace filigree::grid {
namespace {

template <class T>
uint64_t bytesIn(const std::vector<T>& list) {
    return list.size() * sizeof(T);
}

// A vertex of a quad, and where it stands in it.
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
    if (!attributes.looseSources.empty()) point.source = attributes.looseSources[triangle];
    if (attributes.looseTriangles.empty()) return point;
    const auto& corners = attributes.looseTriangles[triangle];
    point.normal = blendedAt(attributes.looseNormals, corners, weights);
    point.uv = blendedAt(attributes.looseUvs, corners, weights);
    return point;
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

SurfacePoint surfaceAt(const GridAttributes& attributes, std::span<const VertexGrid> table, const Hit& hit) {
    const std::array<float, 3> weights{1 - hit.u - hit.v, hit.u, hit.v};
    if (hit.grid == looseGrid) return loosePoint(attributes, hit.column, weights);
    const VertexGrid& grid = table[hit.grid];
    const uint64_t quad = grid.firstQuad + uint64_t{hit.row} * (grid.columns - 1) + hit.column;
    const Diagonal diagonal = attributes.diagonals.empty() ? Diagonal::ac : attributes.diagonals[quad];
    SurfacePoint point;
    std::array<uint64_t, 3> vertices{};
    const auto corners = cornersOf(diagonal, hit.half);
    for (size_t k = 0; k < 3; ++k) {
        const auto column = hit.column + corners[k].column;
        const auto row = hit.row + corners[k].row;
        vertices[k] = grid.firstVertex + uint64_t{row} * grid.columns + column;
        point.gridU += weights[k] * static_cast<float>(column) / static_cast<float>(grid.columns - 1);
        point.gridV += weights[k] * static_cast<float>(row) / static_cast<float>(grid.rows - 1);
    }
    point.source = attributes.quadSources.empty() ? static_cast<uint32_t>(2 * quad + hit.half)
                                                  : attributes.quadSources[quad][hit.half];
    point.normal = blendedAt(attributes.normals, vertices, weights);
    point.uv = blendedAt(attributes.uvs, vertices, weights);
    return point;
}

}  // namespace filigree::grid
