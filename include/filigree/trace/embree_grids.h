// The same grids under Embree, uncompressed: what compressed grids are measured against.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/result.h"
#include "filigree/grid/rays.h"
#include "filigree/grid/vertex_grid.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

namespace filigree::trace {

// How Embree holds grids.
enum class EmbreeLayout : uint8_t {
    triangles,         // an indexed triangle mesh, as Embree comes
    trianglesCompact,  // the same with RTC_SCENE_FLAG_COMPACT
    trianglesQbvh8,    // the same with quantised nodes, as Benthin, Vaidyanathan and Woop (2021) compare with
    grids,             // RTC_GEOMETRY_TYPE_GRID, and an indexed mesh of the loose triangles
    gridsCompact,      // the same with RTC_SCENE_FLAG_COMPACT
};
inline constexpr size_t embreeLayoutCount = 5;
// The names of the command line, and the way back.
FILIGREE_API std::string_view nameOf(EmbreeLayout layout);
FILIGREE_API std::optional<EmbreeLayout> embreeLayoutNamed(std::string_view name);

// How Embree builds.
struct EmbreeOptions {
    bool robust = false;   // RTC_SCENE_FLAG_ROBUST
    unsigned threads = 1;  // of the build; 0: one for each processor
};

// What a ray hits.
struct EmbreeHit {
    float t = std::numeric_limits<float>::infinity();  // infinite where nothing is hit
    uint32_t primitive = 0;                            // triangle or grid, within its geometry
    float u = 0;                                       // of a triangle the weights of its vertices 1 and 2
    float v = 0;
    Vec3 normal{};  // world units, not of length 1
};

// Each quad of a triangle mesh has its own diagonal. Grids have one each, which most of their quads have; an
// Embree grid's diagonal runs from b to d (grid/vertex_grid.h), so grids of the other are laid out mirrored.
class FILIGREE_API EmbreeGrids {
  public:
    // ErrorKind::limit when Embree runs out of memory.
    static Result<EmbreeGrids> build(const grid::GridMesh& mesh, EmbreeLayout layout,
                                     const EmbreeOptions& options);

    EmbreeGrids(EmbreeGrids&&) noexcept;
    EmbreeGrids& operator=(EmbreeGrids&&) noexcept;
    ~EmbreeGrids();

    // All that stays in memory: Embree's own count, and the buffers of vertices and indices that it shares.
    [[nodiscard]] uint64_t bytes() const;
    [[nodiscard]] double buildSeconds() const;  // of the commit alone

    // Ray by ray, and through Embree's stream calls, which quantised nodes lack: they go ray by ray. `hits`
    // and `answers` (1 or 0) as long as `rays`.
    void closest(std::span<const grid::Ray> rays, std::span<EmbreeHit> hits) const;
    void any(std::span<const grid::Ray> rays, std::span<uint8_t> answers) const;
    void closestStreamed(std::span<const grid::Ray> rays, std::span<EmbreeHit> hits) const;
    void anyStreamed(std::span<const grid::Ray> rays, std::span<uint8_t> answers) const;

  private:
    struct Data;
    explicit EmbreeGrids(std::unique_ptr<Data> data);
    std::unique_ptr<Data> data_;
};

}  // namespace filigree::trace
