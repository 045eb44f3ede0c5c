#include "filigree/grid/convert.h"

#include "filigree/core/stage.h"

#include "grid/assemble.h"

#include <fmt/format.h>

namespace filigree::grid {

Result<GridMesh> gridsOf(const mesh::FaceMesh& mesh, const ConvertOptions& options, const Executor& executor,
                         ProgressSink& progress) {
    if (const Status sound = mesh::check(mesh); !sound) return sound.error();
    if (mesh.triangleCount() > maxConvertTriangles) {
        return Error{ErrorKind::limit, fmt::format("{} triangles, at most {} are made into grids",
                                                   mesh.triangleCount(), maxConvertTriangles)};
    }
    const Stage stage(executor, progress, "convert", mesh.triangleCount(), "triangles");
    const Topology topology = topologyOf(mesh, options.attributes);
    const Choice choice =
        chooseGrids(topology, mesh.positions, {options.uniformDiagonals, options.turnQuads}, stage);
    if (const Status status = stage.status(); !status) return status.error();
    return assemble(mesh, topology, choice, options, executor);
}

}  // namespace filigree::grid
