// The triangles of a scene in one mesh.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/result.h"
#include "filigree/mesh/face_mesh.h"
#include "filigree/scene/scene.h"

#include <cstdint>

namespace filigree::scene {

// What opaqueFaces() gives.
struct SceneFaces {
    mesh::FaceMesh mesh;   // world units; texture coordinates where any primitive has them, else 0
    uint64_t leftOut = 0;  // triangles of masked and blended materials
};

// The triangles of all opaque primitives, placed by every instance, in the order of the instances and then
// the primitives. Where an instance mirrors, the second and third vertex change places, so that front stays
// front. Fails where a placed vertex is not finite (the error names mesh and primitive), and at 2^32
// vertices.
FILIGREE_API Result<SceneFaces> opaqueFaces(const Scene& scene);

}  // namespace filigree::scene
