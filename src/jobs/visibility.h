// Which triangle each pixel of a view sees.
#pragma once

#include "filigree/core/vec3.h"
#include "filigree/image/alpha_image.h"
#include "filigree/mesh/uv_triangle.h"
#include "filigree/scene/scene.h"

#include <array>
#include <cstdint>
#include <vector>

namespace filigree::jobs {

struct WorldTriangle {
    std::array<Vec3, 3> position;
    std::array<mesh::Uv, 3> uv;
    int material = -1;
};

// All instances' triangles in world space.
std::vector<WorldTriangle> worldTriangles(const scene::Scene& scene);

// A place in a view: x and y run from -w to w over the picture (y upward), and less z / w is nearer.
struct ClipPoint {
    double x = 0, y = 0, z = 0, w = 1;
};

// From world space into a view.
class Projection {
  public:
    static Projection perspective(const scene::Camera& camera, double aspect);
    // Parallel rays along `direction`, over the square of half-width `reach` about `centre`.
    static Projection parallel(const Vec3& direction, const Vec3& centre, double reach);

    [[nodiscard]] ClipPoint operator()(const Vec3& p) const;

  private:
    std::array<std::array<double, 4>, 4> rows_{};  // of the matrix to clip space
};

// Barycentric weights of a triangle's three corners.
using Weights = std::array<double, 3>;

struct Visibility {
    static constexpr uint32_t nothing = ~0U;
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<uint32_t> triangle;             // [width * height], or nothing
    std::vector<double> depth;                  // z / w of it
    std::vector<std::array<float, 2>> weights;  // of its corners 1 and 2
};

// Draws all triangles, those of MASK materials where their alpha passes. The images' alphas must be decoded.
Visibility findVisible(const std::vector<WorldTriangle>& triangles, const scene::Scene& scene,
                       const Projection& projection, uint32_t width, uint32_t height);

}  // namespace filigree::jobs
