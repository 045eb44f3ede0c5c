// The ways to hold grids in memory and trace rays against them, alike from outside.
#pragma once

#include "filigree/core/executor.h"
#include "filigree/core/result.h"
#include "filigree/grid/encoded_grids.h"
#include "filigree/grid/rays.h"
#include "filigree/grid/vertex_grid.h"
#include "filigree/jobs/grids.h"
#include "filigree/trace/embree_grids.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace filigree::jobs {

// What rays are traced against in one of the ways.
class GridMethod {
  public:
    virtual ~GridMethod() = default;

    // All that must stay in memory.
    [[nodiscard]] virtual uint64_t bytes() const = 0;
    [[nodiscard]] virtual double buildSeconds() const = 0;
    // Working memory of one thread beside it.
    [[nodiscard]] virtual uint64_t cacheBytes() const { return 0; }

    // Whether there is a call for many rays that is worth timing.
    [[nodiscard]] virtual bool hasBatches() const = 0;
    // Traces rays one by one, or as a batch where there is a call for that. Distances, infinite where nothing
    // is hit, and 1 or 0; as long as `rays`.
    virtual void closest(std::span<const grid::Ray> rays, bool batched, std::span<float> distances) = 0;
    virtual void any(std::span<const grid::Ray> rays, bool batched, std::span<uint8_t> answers) = 0;

    // The surface as rays meet it.
    [[nodiscard]] virtual grid::GridMesh surface(const Executor& executor) const = 0;
};

// As the command line calls them.
std::span<const std::string_view> gridMethodNames();
bool isGridMethod(std::string_view name);

// What methods are made for.
struct GridScene {
    std::string name;
    grid::GridMesh mesh;
    // With uniform diagonals (grid::ConvertOptions), where `mesh` has others: the codec `paper` needs them.
    std::optional<grid::GridMesh> uniformMesh;
    GridPrecision precision;  // of the codec `lattice`

    grid::GridMesh& meshFor(grid::Codec codec) {
        return codec == grid::Codec::paper && uniformMesh ? *uniformMesh : mesh;
    }
};

// Lays the scene out for one of them; `scene` must outlive it. The order of loose triangles may change.
Result<std::unique_ptr<GridMethod>> makeGridMethod(std::string_view name, GridScene& scene,
                                                   const Executor& executor);

}  // namespace filigree::jobs
