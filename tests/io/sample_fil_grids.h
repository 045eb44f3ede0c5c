// Small .fil files of grids.
#pragma once

#include "filigree/io/fil_grids.h"

#include "grid/sample_grids.h"

#include <cstdint>

namespace filigree::tests {

// With every section that a file may have, or without attributes.
inline io::FilGrids sampleFilGrids(grid::Codec codec, bool withAttributes = true, uint32_t side = 8) {
    io::FilGrids contents;
    grid::GridMesh mesh = grid::tests::mixedBox(side);
    contents.grids = grid::tests::encoded(mesh, grid::tests::optionsFor(mesh, codec));
    contents.asset = {"box.ply", 4321, {7, 9}};
    contents.table = mesh.grids;
    contents.looseTriangles = static_cast<uint32_t>(mesh.looseTriangles.size());
    if (!withAttributes) return contents;
    mesh.normals.assign(mesh.vertices.size(), {0, 1, 0});
    mesh.looseNormals.assign(mesh.looseVertices.size(), {1, 0, 0});
    mesh.uvs.assign(mesh.vertices.size(), {0.25F, 0.5F});
    mesh.looseUvs.assign(mesh.looseVertices.size(), {0.75F, 1});
    mesh.quadSources.resize(mesh.quadCount());
    for (uint32_t q = 0; q < mesh.quadSources.size(); ++q) mesh.quadSources[q] = {3 * q, 3 * q + 1};
    contents.attributes = grid::attributesOf(mesh);
    return contents;
}

}  // namespace filigree::tests
