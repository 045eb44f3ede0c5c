// Small meshes of grids and loose triangles.
#pragma once

#include "filigree/grid/encode_grids.h"
#include "filigree/grid/lattice_choice.h"
#include "filigree/grid/shapes.h"
#include "filigree/grid/vertex_grid.h"

namespace filigree::grid::tests {

// The last grid of `mesh` as loose triangles, over the same positions.
inline GridMesh withLastGridLoose(GridMesh mesh) {
    const VertexGrid last = mesh.grids.back();
    mesh.grids.pop_back();
    const auto from = mesh.vertices.begin() + static_cast<ptrdiff_t>(last.firstVertex);
    mesh.looseVertices.assign(from, mesh.vertices.end());
    mesh.vertices.erase(from, mesh.vertices.end());
    for (uint32_t row = 0; row + 1 < last.rows; ++row) {
        for (uint32_t column = 0; column + 1 < last.columns; ++column) {
            const uint32_t a = row * last.columns + column;
            const uint32_t d = a + last.columns;
            mesh.looseTriangles.push_back({a, a + 1, d + 1});
            mesh.looseTriangles.push_back({a, d + 1, d});
        }
    }
    for (uint32_t t = 0; t < mesh.looseTriangles.size(); ++t)
        mesh.looseSources.push_back(static_cast<uint32_t>(2 * last.firstQuad) + t);
    if (!mesh.diagonals.empty()) mesh.diagonals.resize(last.firstQuad);
    return mesh;
}

// Four grids out of phase, the last of them loose.
inline GridMesh mixedBox(uint32_t side) {
    return withLastGridLoose(box(side, serialExecutor()));
}

inline EncodeOptions optionsFor(const GridMesh& mesh, Codec codec, bool snap = false) {
    EncodeOptions options;
    options.codec = codec;
    options.snap = snap;
    if (codec == Codec::lattice) options.lattice = latticeForError(mesh, 1e-3).value();
    return options;
}

// Encodes what can be encoded.
inline EncodedGrids encoded(GridMesh& mesh, const EncodeOptions& options,
                            const Executor& executor = serialExecutor()) {
    return encodeGrids(mesh, options, executor, silentProgress()).value();
}

}  // namespace filigree::grid::tests
