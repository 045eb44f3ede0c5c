// The deep half of validate: every micro-triangle of a scene against its texture.
#pragma once

#include "filigree/jobs/validate.h"
#include "filigree/scene/scene.h"

namespace filigree::jobs {

// Examines all primitives of `scene` that have micromaps, under the parameters that the micromaps record, and
// adds what it finds to `summary`. Moves index lists of the scene about; they are as before when it returns.
Status validateDeep(scene::Scene& scene, double sample, const Executor& executor, ProgressSink& progress,
                    ValidateSummary& summary);

}  // namespace filigree::jobs
