// Files to vertex grids.
#pragma once

#include "filigree/core/executor.h"
#include "filigree/core/result.h"
#include "filigree/grid/convert.h"
#include "filigree/grid/vertex_grid.h"
#include "filigree/io/heightfield.h"

#include <filesystem>
#include <string>
#include <vector>

namespace filigree::jobs {

struct GridInput {
    grid::GridMesh mesh;
    double readSeconds = 0;
    double convertSeconds = 0;
    std::vector<std::string> notes;
};

// Fails with ErrorKind::usage on a name that readGridInput does not take.
Status checkGridInput(const std::filesystem::path& path);
bool isHeightfield(const std::filesystem::path& path);

// A .png as a heightfield, the opaque triangles of a .glb or .gltf, a .ply. Fails with ErrorKind::usage on
// any other name, with ErrorKind::format on a mesh without triangles.
Result<GridInput> readGridInput(const std::filesystem::path& path, const grid::ConvertOptions& converting,
                                const io::HeightfieldOptions& heights, const Executor& executor);

}  // namespace filigree::jobs
