#include "filigree/scene/faces.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace filigree::scene {
namespace {

bool isOpaque(const Scene& scene, const Primitive& primitive) {
    return primitive.material < 0 ||
           scene.materials[static_cast<size_t>(primitive.material)].alphaMode == AlphaMode::opaque;
}

bool hasOpaqueUvs(const Scene& scene) {
    return std::ranges::any_of(scene.meshes, [&](const Mesh& mesh) {
        return std::ranges::any_of(mesh.primitives,
                                   [&](const Primitive& p) { return isOpaque(scene, p) && !p.uvs.empty(); });
    });
}

bool mirrors(const std::array<float, 16>& m) {
    return dot(cross({m[0], m[1], m[2]}, {m[4], m[5], m[6]}), {m[8], m[9], m[10]}) < 0;
}

Status appendPositions(const Scene& scene, const Primitive& primitive, const Instance& instance,
                       std::vector<Vec3>& positions) {
    for (size_t v = 0; v < primitive.positions.size(); ++v) {
        const Vec3 world = transformed(instance.transform, primitive.positions[v]);
        if (!std::isfinite(world[0]) || !std::isfinite(world[1]) || !std::isfinite(world[2])) {
            return Error{
                ErrorKind::format,
                fmt::format("mesh {} (\"{}\"), primitive {}: vertex {} is at ({}, {}, {}), expected finite",
                            instance.mesh, scene.meshes[instance.mesh].name, primitive.primitiveIndex, v,
                            world[0], world[1], world[2])};
        }
        positions.push_back(world);
    }
    return {};
}

void appendFaces(const Primitive& primitive, uint32_t firstVertex, bool mirrored,
                 std::vector<mesh::Face>& faces) {
    for (size_t t = 0; t < primitive.triangleCount(); ++t) {
        const uint32_t* corner = &primitive.indices[3 * t];
        mesh::Face face{firstVertex + corner[0], firstVertex + corner[1], firstVertex + corner[2],
                        mesh::noVertex};
        if (mirrored) std::swap(face[1], face[2]);
        faces.push_back(face);
    }
}

Status appendPrimitive(const Scene& scene, const Primitive& primitive, const Instance& instance, bool withUvs,
                       SceneFaces& out) {
    if (!isOpaque(scene, primitive)) {
        out.leftOut += primitive.triangleCount();
        return {};
    }
    mesh::FaceMesh& mesh = out.mesh;
    const size_t firstVertex = mesh.positions.size();
    if (firstVertex + primitive.positions.size() >= mesh::noVertex) {
        return Error{ErrorKind::limit,
                     fmt::format("instances of mesh {}: 2^32 vertices and more", instance.mesh)};
    }
    const Status placed = appendPositions(scene, primitive, instance, mesh.positions);
    if (!placed) return placed.error();
    appendFaces(primitive, static_cast<uint32_t>(firstVertex), mirrors(instance.transform), mesh.faces);
    if (!withUvs) return {};
    mesh.uvs.insert(mesh.uvs.end(), primitive.uvs.begin(), primitive.uvs.end());
    mesh.uvs.resize(mesh.positions.size());
    return {};
}

}  // namespace

Result<SceneFaces> opaqueFaces(const Scene& scene) {
    SceneFaces out;
    const bool withUvs = hasOpaqueUvs(scene);
    for (const Instance& instance : scene.instances) {
        for (const Primitive& primitive : scene.meshes[instance.mesh].primitives) {
            const Status added = appendPrimitive(scene, primitive, instance, withUvs, out);
            if (!added) return added.error();
        }
    }
    return out;
}

}  // namespace filigree::scene
