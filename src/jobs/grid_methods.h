// The ways to hold grids in memory and trace rays against them, alike from outside.
#pragma once

#include "filigree/core/executor.h"
#include "filigree/core/result.h"
#include "filigree/grid/encoded_grids.h"
#include "filigree/grid/rays.h"
#include "filigree/grid/vertex_grid.h"
#include "filigree/trace/embree_grids.h"

#include <cstdint>
#include <memory>
#include <span>
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

    // The vertices as rays meet them, those of `mesh` where nothing changes them.
    [[nodiscard]] virtual Result<grid::GridMesh> decoded(const grid::GridMesh& mesh) const { return mesh; }
};

// As the command line calls them.
std::span<const std::string_view> gridMethodNames();
bool isGridMethod(std::string_view name);

// Lays `mesh` out for one of them.
Result<std::unique_ptr<GridMethod>> makeGridMethod(std::string_view name, const grid::GridMesh& mesh,
                                                   const Executor& executor);

}  // namespace filigree::jobs
