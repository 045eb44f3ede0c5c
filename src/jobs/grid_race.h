// Rays against grids, all methods taking turns on one thread.
#pragma once

#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/trace/grid_rays.h"

#include "jobs/grid_methods.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace filigree::jobs {

// The kinds of rays of trace::GridRaySets.
enum class GridRayKind : uint8_t { primary, bounce, ao, shuffled };
inline constexpr size_t gridRayKindCount = 4;

// Compared with the first method, whose rays go one by one, and with its batches: medians of the rounds.
struct GridSpeed {
    double mraysPerSecond = 0;
    double ratio = 0;
    double ratioToBatches = 0;
    uint64_t hits = 0;
    bool batched = false;  // asked as a batch, which was quicker than ray by ray
};
using GridSpeeds = std::array<GridSpeed, gridRayKindCount>;

// Medians over `rounds` rounds, in CPU time. The first of `methods` must have batches. Others that have them
// are asked in both ways, and the quicker counts.
Result<std::vector<GridSpeeds>> raceGrids(std::span<GridMethod* const> methods,
                                          const trace::GridRaySets& rays, unsigned rounds,
                                          ProgressSink& progress);

}  // namespace filigree::jobs
