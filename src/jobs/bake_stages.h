// The stages of a bake up to the quadtrees, for all that goes on from there.
#pragma once

#include "filigree/bake/bake.h"
#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/jobs/bake.h"
#include "filigree/scene/scene.h"

#include "jobs/alpha_source.h"

#include <string>
#include <vector>

namespace filigree::jobs {

// The primitives of one alpha source, baked.
struct BakedGroup {
    AlphaGroup alpha;
    std::string name;
    image::AlphaTest test;
    bake::Baked baked;  // indices of all its primitives, one after another
};

// Whether the primitives of a material get micromaps, and what these are baked from.
bool isBaked(const scene::Material& material, const BakeParameters& parameters);
AlphaSource sourceToBake(const scene::Material& material, const BakeParameters& parameters);

// Drops the micromaps that the scene came with, sorts the primitives that get new ones by alpha source and
// bakes each group, by the order in which the sources occur. Counts triangles and notes into `summary`. The
// groups look into `scene`. The budget is left to the caller.
Result<std::vector<BakedGroup>> bakeGroups(scene::Scene& scene, const BakeParameters& parameters,
                                           const Executor& executor, ProgressSink& progress,
                                           BakeSummary& summary);

}  // namespace filigree::jobs
