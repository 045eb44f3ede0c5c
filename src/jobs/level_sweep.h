// What verbs share that bake one scene at several levels.
#pragma once

#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/jobs/bake.h"
#include "filigree/scene/scene.h"

#include "jobs/scene_maps.h"

#include <filesystem>
#include <span>

namespace filigree::jobs {

// ErrorKind::usage without a level or above the highest.
Status checkLevels(std::span<const unsigned> levels);

// A scene to bake, without the micromaps that it carries.
Result<scene::Scene> readUnbaked(const std::filesystem::path& input, const BakeParameters& parameters);

// Bakes what was read from `input`, whatever states and level `parameters` have.
Result<SceneMaps> bakeAt(scene::Scene& scene, const std::filesystem::path& input, BakeParameters parameters,
                         unsigned level, unsigned states, const Executor& executor, ProgressSink& progress);

}  // namespace filigree::jobs
