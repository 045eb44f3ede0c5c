#include "filigree/mesh/face_mesh.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace filigree::mesh {
namespace {

bool allFinite(const Vec3& v) {
    return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

Status checkAttribute(size_t found, size_t vertices, const char* name) {
    if (found == 0 || found == vertices) return {};
    return Error{ErrorKind::format, fmt::format("{} {} for {} vertices", found, name, vertices)};
}

Status checkFace(const Face& face, size_t number, size_t vertices) {
    const size_t corners = isQuad(face) ? 4 : 3;
    for (size_t k = 0; k < corners; ++k) {
        if (face[k] >= vertices) {
            return Error{ErrorKind::format,
                         fmt::format("face {}: vertex {}, expected below {}", number, face[k], vertices)};
        }
    }
    return {};
}

}  // namespace

uint64_t FaceMesh::triangleCount() const {
    return faces.size() + static_cast<uint64_t>(std::ranges::count_if(faces, isQuad));
}

Status check(const FaceMesh& mesh) {
    const size_t vertices = mesh.positions.size();
    for (size_t v = 0; v < vertices; ++v) {
        const Vec3& p = mesh.positions[v];
        if (!allFinite(p)) {
            return Error{ErrorKind::format, fmt::format("vertex {}: position ({}, {}, {}), expected finite",
                                                        v, p[0], p[1], p[2])};
        }
    }
    for (size_t f = 0; f < mesh.faces.size(); ++f) {
        if (const Status face = checkFace(mesh.faces[f], f, vertices); !face) return face.error();
    }
    if (const Status normals = checkAttribute(mesh.normals.size(), vertices, "normals"); !normals)
        return normals.error();
    if (const Status uvs = checkAttribute(mesh.uvs.size(), vertices, "texture coordinates"); !uvs)
        return uvs.error();
    if (mesh.triangleCount() > UINT32_MAX) {
        return Error{ErrorKind::limit,
                     fmt::format("{} triangles, at most {} are numbered", mesh.triangleCount(), UINT32_MAX)};
    }
    return {};
}

}  // namespace filigree::mesh
