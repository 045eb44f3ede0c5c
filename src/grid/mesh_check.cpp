#include "grid/mesh_check.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

namespace filigree::grid {
namespace {

constexpr uint32_t mostSide = 1 << 16;

Status checkGridTable(const GridMesh& mesh) {
    uint64_t vertices = 0;
    uint64_t quads = 0;
    for (size_t k = 0; k < mesh.grids.size(); ++k) {
        const VertexGrid& grid = mesh.grids[k];
        const auto fits = [](uint32_t side) { return side >= 2 && side <= mostSide; };
        if (!fits(grid.columns) || !fits(grid.rows))
            return Error{ErrorKind::format,
                         fmt::format("grid {}: {} x {} vertices, expected sides of 2 to {}", k, grid.columns,
                                     grid.rows, mostSide)};
        if (grid.firstVertex != vertices || grid.firstQuad != quads)
            return Error{ErrorKind::format,
                         fmt::format("grid {}: begins at vertex {} and quad {}, expected {} and {}", k,
                                     grid.firstVertex, grid.firstQuad, vertices, quads)};
        vertices += grid.vertexCount();
        quads += grid.quadCount();
    }
    if (mesh.vertices.size() == vertices) return {};
    return Error{ErrorKind::format,
                 fmt::format("{} vertices of grids, their tables say {}", mesh.vertices.size(), vertices)};
}

Status checkLength(std::string_view list, size_t found, uint64_t expected) {
    if (found == 0 || found == expected) return {};
    return Error{ErrorKind::format, fmt::format("{} {}, expected {} or none", found, list, expected)};
}

Status checkLengths(const GridMesh& mesh) {
    const uint64_t quads = mesh.quadCount();
    Status status = checkLength("diagonals", mesh.diagonals.size(), quads);
    if (status) status = checkLength("sources of quads", mesh.quadSources.size(), quads);
    if (status) status = checkLength("loose sources", mesh.looseSources.size(), mesh.looseTriangles.size());
    if (status) status = checkLength("normals", mesh.normals.size(), mesh.vertices.size());
    if (status) status = checkLength("loose normals", mesh.looseNormals.size(), mesh.looseVertices.size());
    if (status) status = checkLength("texture coordinates", mesh.uvs.size(), mesh.vertices.size());
    if (status)
        status = checkLength("loose texture coordinates", mesh.looseUvs.size(), mesh.looseVertices.size());
    return status;
}

Status checkLoose(const GridMesh& mesh) {
    for (size_t t = 0; t < mesh.looseTriangles.size(); ++t) {
        const uint32_t most = std::ranges::max(mesh.looseTriangles[t]);
        if (most >= mesh.looseVertices.size())
            return Error{ErrorKind::format, fmt::format("loose triangle {}: vertex {}, expected below {}", t,
                                                        most, mesh.looseVertices.size())};
    }
    return {};
}

Status checkFinite(std::string_view list, const std::vector<Vec3>& points, const Executor& executor) {
    std::atomic<size_t> first = points.size();
    executor.parallelFor(points.size(), 65536, [&](size_t begin, size_t end) {
        for (size_t k = begin; k < end; ++k) {
            if (std::ranges::all_of(points[k], [](float c) { return std::isfinite(c); })) continue;
            for (size_t least = first; k < least && !first.compare_exchange_weak(least, k);) {
            }
            return;
        }
    });
    if (first == points.size()) return {};
    return Error{ErrorKind::format, fmt::format("{} {} is not finite", list, first.load())};
}

}  // namespace

Status checkTables(const GridMesh& mesh, const Executor& executor) {
    Status status = checkGridTable(mesh);
    if (status) status = checkLengths(mesh);
    if (status) status = checkLoose(mesh);
    if (status) status = checkFinite("vertex", mesh.vertices, executor);
    if (status) status = checkFinite("loose vertex", mesh.looseVertices, executor);
    return status;
}

}  // namespace filigree::grid
