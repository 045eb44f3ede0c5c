#include "capi/triangles.h"

#include "capi/floats.h"
#include "capi/sized.h"

namespace filigree::capi {
namespace {

constexpr filigree_triangles triangleDefaults = FILIGREE_TRIANGLES_INIT;
constexpr size_t mostTriangles = size_t{1} << 30;

}  // namespace

Triangles::Triangles(const filigree_triangles* given)
    : given_(takenOf(given, triangleDefaults, "triangles")) {
    within(given_.triangle_count, size_t{0}, mostTriangles, "triangles.triangle_count");
    if (given_.triangle_count > 0) required(given_.uvs, "triangles.uvs");
    if (given_.indices != nullptr) {
        indices_ = Indices(given_.indices, given_.index_bytes, 3 * size(), "triangles.indices");
        for (size_t k = 0; k < 3 * size(); ++k) {
            if (indices_[k] >= given_.vertex_count) {
                fail(FILIGREE_ERROR_ARGUMENT,
                     "triangles: vertex {} of triangle {} is {}, expected less than {}", k % 3, k / 3,
                     indices_[k], given_.vertex_count);
            }
        }
    }
    if (given_.vertex_alpha == nullptr) return;
    for (size_t t = 0; t < size(); ++t) {
        for (size_t k = 0; k < 3; ++k) {
            const float alpha = vertexAlpha(vertex(t, k));
            if (!(alpha >= 0 && alpha <= 1))
                fail(FILIGREE_ERROR_ARGUMENT,
                     "triangles: vertex {} of triangle {} has alpha {}, expected 0 to 1", k, t, alpha);
        }
    }
}

size_t Triangles::vertexCount() const {
    return given_.indices == nullptr ? 3 * size() : given_.vertex_count;
}

mesh::Uv Triangles::uv(size_t triangle, size_t corner) const {
    const float* first = given_.uvs;
    size_t number = vertex(triangle, corner);
    if (given_.indices == nullptr && given_.triangle_stride != 0) {
        first = reinterpret_cast<const float*>(reinterpret_cast<const unsigned char*>(first) +
                                               triangle * given_.triangle_stride);
        number = corner;
    }
    const auto [u, v] = floatsAt<2>(first, given_.uv_stride, number);
    return {u, v};
}

std::array<float, 3> Triangles::position(size_t vertex) const {
    return floatsAt<3>(given_.positions, given_.position_stride, vertex);
}

float Triangles::vertexAlpha(size_t vertex) const {
    return floatsAt<1>(given_.vertex_alpha, given_.vertex_alpha_stride, vertex)[0];
}

mesh::UvTriangle Triangles::operator[](size_t triangle) const {
    mesh::UvTriangle one;
    for (size_t k = 0; k < 3; ++k) {
        one.uv[k] = uv(triangle, k);
        if (given_.vertex_alpha != nullptr) one.alpha[k] = vertexAlpha(vertex(triangle, k));
    }
    return one;
}

std::vector<mesh::UvTriangle> Triangles::all() const {
    std::vector<mesh::UvTriangle> triangles(size());
    for (size_t t = 0; t < size(); ++t) triangles[t] = (*this)[t];
    return triangles;
}

}  // namespace filigree::capi

filigree_error filigree_triangles_init(filigree_triangles* triangles, size_t struct_size) {
    return filigree::capi::initialise(triangles, struct_size, filigree::capi::triangleDefaults);
}
