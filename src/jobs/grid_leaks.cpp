#include "jobs/grid_leaks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace filigree::jobs {
namespace {

constexpr uint64_t raysAtATime = 16384;
// How far beyond its target, of the way to it, a ray may meet the surface: rounding of the distance.
constexpr float slack = 1e-4F;
constexpr size_t raysToLookAround = 64;

// Points to aim at, in the order of the grids.
class Targets {
  public:
    explicit Targets(const grid::GridMesh& mesh) : mesh_(mesh) {}

    // By turns a vertex, and a point of an edge along a row, along a column and along the diagonal from it.
    Vec3 next() {
        const grid::VertexGrid& grid = mesh_.grids[grid_];
        const Vec3 target = at(grid);
        if (++turn_ < 4) return target;
        turn_ = 0;
        if (++column_ < grid.columns) return target;
        column_ = 0;
        if (++row_ < grid.rows) return target;
        row_ = 0;
        grid_ = (grid_ + 1) % mesh_.grids.size();
        return target;
    }

  private:
    Vec3 at(const grid::VertexGrid& grid) {
        const uint32_t right = std::min(column_ + 1, grid.columns - 1);
        const uint32_t below = std::min(row_ + 1, grid.rows - 1);
        switch (turn_) {
            case 0:
                return vertex(grid, column_, row_);
            case 1:
                return between(vertex(grid, column_, row_), vertex(grid, right, row_));
            case 2:
                return between(vertex(grid, column_, row_), vertex(grid, column_, below));
            default:
                return onDiagonal(grid, right, below);
        }
    }

    Vec3 onDiagonal(const grid::VertexGrid& grid, uint32_t right, uint32_t below) {
        const uint64_t quad = grid.firstQuad + uint64_t{std::min(row_, grid.rows - 2)} * (grid.columns - 1) +
                              std::min(column_, grid.columns - 2);
        if (mesh_.diagonalOf(quad) == grid::Diagonal::ac)
            return between(vertex(grid, column_, row_), vertex(grid, right, below));
        return between(vertex(grid, right, row_), vertex(grid, column_, below));
    }

    [[nodiscard]] const Vec3& vertex(const grid::VertexGrid& grid, uint32_t column, uint32_t row) const {
        return mesh_.vertices[grid.firstVertex + uint64_t{row} * grid.columns + column];
    }
    Vec3 between(const Vec3& a, const Vec3& b) {
        return plus(a, times(minus(b, a), static_cast<float>(random_.uniform(0, 1))));
    }

    const grid::GridMesh& mesh_;
    Random random_{1};
    size_t grid_ = 0;
    uint32_t row_ = 0;
    uint32_t column_ = 0;
    unsigned turn_ = 0;
};

Vec3 nearOrigin(Random& random, float reach) {
    const auto next = [&] { return static_cast<float>(random.uniform(-1, 1)) * reach; };
    const float x = next();
    const float y = next();
    return {x, y, next()};
}

// Whether a place is outside a closed surface: from inside every ray meets something.
bool isOutside(GridMethod& method, const Vec3& place, Random& random) {
    std::array<grid::Ray, raysToLookAround> rays;
    for (grid::Ray& ray : rays) ray = {place, nearOrigin(random, 1)};
    std::array<float, raysToLookAround> distances{};
    method.closest(rays, true, distances);
    return std::ranges::any_of(distances, [](float t) { return !std::isfinite(t); });
}

// A ray may pass the very edge of a bulge that it was aimed at, and meet the surface behind; then the way
// between lies inside.
bool hasLeaked(GridMethod& method, const grid::Ray& ray, float t, Random& random) {
    if (t <= 1 + slack) return false;
    return !std::isfinite(t) ||
           isOutside(method, plus(ray.origin, times(ray.direction, (1 + t) / 2)), random);
}

}  // namespace

// Near the circle of radius 1 that the tube runs about, beside the target.
Vec3 behindTorus(const Vec3& target, Random& random) {
    return plus(normalised({target[0], 0, target[2]}), nearOrigin(random, 0.1F));
}
Vec3 behindBox(const Vec3&, Random& random) {
    return nearOrigin(random, 0.5F);
}

GridLeaks countLeaks(GridMethod& method, const grid::GridMesh& mesh, const PointBehind& pointBehind,
                     uint64_t count) {
    Targets targets(mesh);
    Random random(2);
    GridLeaks leaks;
    std::vector<grid::Ray> rays;
    std::vector<float> distances;
    while (leaks.rays < count) {
        rays.resize(std::min(raysAtATime, count - leaks.rays));
        distances.resize(rays.size());
        for (grid::Ray& ray : rays) {
            const Vec3 target = targets.next();
            ray.origin = pointBehind(target, random);
            ray.direction = minus(target, ray.origin);
        }
        method.closest(rays, true, distances);
        leaks.rays += rays.size();
        for (size_t k = 0; k < rays.size(); ++k)
            leaks.misses += hasLeaked(method, rays[k], distances[k], random) ? 1 : 0;
    }
    return leaks;
}

}  // namespace filigree::jobs
