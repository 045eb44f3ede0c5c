// Rays against compressed grids.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/vec3.h"
#include "filigree/grid/encoded_grids.h"

#include <cstdint>
#include <limits>
#include <memory>
#include <span>

namespace filigree::grid {

// Points origin + t * direction with tMin <= t <= tMax, in world units.
struct Ray {
    Vec3 origin{};
    Vec3 direction{};  // any length but zero
    float tMin = 0;
    float tMax = std::numeric_limits<float>::infinity();
};

// What Hit::grid says besides a grid: nothing is hit, or a loose triangle.
inline constexpr uint32_t noGrid = 0xffffffff;
inline constexpr uint32_t looseGrid = 0xfffffffe;  // a triangle of a cluster

// What a ray hits.
struct Hit {
    float t = std::numeric_limits<float>::infinity();
    uint32_t grid = noGrid;  // into GridMesh::grids, or looseGrid, or noGrid where nothing is hit
    uint32_t column = 0;     // of the quad; of looseGrid the loose triangle, in the order of the clusters
    uint32_t row = 0;
    uint8_t half = 0;  // 0 or 1: which triangle of the quad (grid/vertex_grid.h)
    float u = 0;       // weights of the triangle's vertices 1 and 2
    float v = 0;
    Vec3 normal{};  // (p1 - p0) x (p2 - p0), world units, not of length 1
};

// Traces rays on one thread; keeps a cache of decoded blocks. The same answers whatever was traced before.
class FILIGREE_API Tracer {
  public:
    // `grids` must outlive it and have passed check() (grid/check.h).
    explicit Tracer(const EncodedGrids& grids);
    Tracer(Tracer&&) noexcept;
    Tracer& operator=(Tracer&&) noexcept;
    ~Tracer();

    // The nearest hit; of equal distances one of them, always the same.
    Hit closest(const Ray& ray);
    bool any(const Ray& ray);

    // Many rays at once, interleaved so that one computes while another waits for memory; the same answers.
    void closest(std::span<const Ray> rays, std::span<Hit> hits);     // both [ray_count]
    void any(std::span<const Ray> rays, std::span<uint8_t> answers);  // 1 or 0

    // Of the cache.
    [[nodiscard]] uint64_t bytes() const;

  private:
    struct Data;
    std::unique_ptr<Data> data_;
};

}  // namespace filigree::grid
