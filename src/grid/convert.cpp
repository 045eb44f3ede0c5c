#include "filigree/grid/convert.h"

#include "grid/assemble.h"

#include <fmt/format.h>

namespace filigree::grid {

Result<GridMesh> gridsOf(const mesh::FaceMesh& mesh, const ConvertOptions& options,
                         const Executor& executor) {
    if (const Status sound = mesh::check(mesh); !sound) return sound.error();
    if (mesh.triangleCount() > maxConvertTriangles) {
        return Error{ErrorKind::limit, fmt::format("{} triangles, at most {} are made into grids",
                                                   mesh.triangleCount(), maxConvertTriangles)};
    }
    const Topology topology = topologyOf(mesh, options.attributes);
    const Choice choice =
        chooseGrids(topology, mesh.positions, {options.uniformDiagonals, options.turnQuads});
    return assemble(mesh, topology, choice, options, executor);
}

}  // namespace filigree::grid
