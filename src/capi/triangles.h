// The caller's triangles as the rooms take them.
#pragma once

#include "filigree/mesh/uv_triangle.h"

#include "capi/indices.h"
#include "filigree.h"

#include <array>
#include <cstddef>
#include <vector>

namespace filigree::capi {

class Triangles {
  public:
    // Throws a Failure unless all of it can be read.
    explicit Triangles(const filigree_triangles* given);

    [[nodiscard]] size_t size() const { return given_.triangle_count; }
    [[nodiscard]] bool hasPositions() const { return given_.positions != nullptr; }
    [[nodiscard]] size_t vertexCount() const;
    [[nodiscard]] size_t vertex(size_t triangle, size_t corner) const {
        return given_.indices == nullptr ? 3 * triangle + corner : indices_[3 * triangle + corner];
    }
    [[nodiscard]] mesh::Uv uv(size_t triangle, size_t corner) const;
    [[nodiscard]] std::array<float, 3> position(size_t vertex) const;

    [[nodiscard]] mesh::UvTriangle operator[](size_t triangle) const;
    [[nodiscard]] std::vector<mesh::UvTriangle> all() const;

  private:
    [[nodiscard]] float vertexAlpha(size_t vertex) const;

    filigree_triangles given_;
    Indices indices_;
};

}  // namespace filigree::capi
