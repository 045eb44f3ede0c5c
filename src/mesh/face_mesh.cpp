#include "filigree/mesh/face_mesh.h"

#include <algorithm>

namespace filigree::mesh {

uint64_t FaceMesh::triangleCount() const {
    return faces.size() + static_cast<uint64_t>(std::ranges::count_if(faces, isQuad));
}

}  // namespace filigree::mesh
