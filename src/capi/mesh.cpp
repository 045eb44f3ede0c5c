#include "capi/mesh.h"

#include "capi/arguments.h"
#include "capi/floats.h"
#include "capi/indices.h"
#include "capi/sized.h"

namespace filigree::capi {
namespace {

constexpr filigree_mesh meshDefaults = FILIGREE_MESH_INIT;
constexpr size_t mostFaces = size_t{1} << 30;

uint32_t vertexAt(const filigree_mesh& from, const Indices& indices, size_t face, size_t corner) {
    const size_t at = face * from.face_vertices + corner;
    const size_t vertex = from.indices == nullptr ? at : indices[at];
    if (corner == 3 && from.indices != nullptr && vertex == indices.greatest()) return mesh::noVertex;
    if (vertex >= from.vertex_count) {
        fail(FILIGREE_ERROR_ARGUMENT, "mesh: vertex {} of face {} is {}, expected less than {}", corner, face,
             vertex, from.vertex_count);
    }
    return static_cast<uint32_t>(vertex);
}

std::vector<mesh::Face> facesIn(const filigree_mesh& from) {
    Indices indices;
    if (from.indices != nullptr)
        indices = Indices(from.indices, from.index_bytes, from.face_count, "mesh.indices");
    std::vector<mesh::Face> faces(from.face_count);
    for (size_t f = 0; f < faces.size(); ++f) {
        faces[f][3] = mesh::noVertex;
        for (size_t k = 0; k < from.face_vertices; ++k) faces[f][k] = vertexAt(from, indices, f, k);
    }
    return faces;
}

}  // namespace

mesh::FaceMesh facesOf(const filigree_mesh* given) {
    const filigree_mesh from = takenOf(given, meshDefaults, "mesh");
    within(from.face_vertices, 3U, 4U, "mesh.face_vertices");
    within(from.face_count, size_t{1}, mostFaces, "mesh.face_count");
    within(from.vertex_count, size_t{1}, size_t{mesh::noVertex} - 1, "mesh.vertex_count");
    required(from.positions, "mesh.positions");
    mesh::FaceMesh mesh;
    mesh.faces = facesIn(from);
    mesh.positions.resize(from.vertex_count);
    if (from.normals != nullptr) mesh.normals.resize(from.vertex_count);
    if (from.uvs != nullptr) mesh.uvs.resize(from.vertex_count);
    for (size_t k = 0; k < from.vertex_count; ++k) {
        mesh.positions[k] = floatsAt<3>(from.positions, from.position_stride, k);
        if (from.normals != nullptr) mesh.normals[k] = floatsAt<3>(from.normals, from.normal_stride, k);
        if (from.uvs == nullptr) continue;
        const auto [u, v] = floatsAt<2>(from.uvs, from.uv_stride, k);
        mesh.uvs[k] = {u, v};
    }
    return mesh;
}

}  // namespace filigree::capi

filigree_error filigree_mesh_init(filigree_mesh* mesh, size_t struct_size) {
    return filigree::capi::initialise(mesh, struct_size, filigree::capi::meshDefaults);
}
