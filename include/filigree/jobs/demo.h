// Everything on a scene made in code: made, baked, validated, inspected, rendered.
#pragma once

#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/jobs/bake.h"
#include "filigree/jobs/grids.h"
#include "filigree/jobs/inspect.h"
#include "filigree/jobs/render.h"
#include "filigree/jobs/validate.h"

#include <filesystem>
#include <string>
#include <vector>

namespace filigree::jobs {

struct DemoOptions {
    std::filesystem::path outputFolder;  // made when missing
    BakeParameters parameters;
    unsigned samples = 8;  // of each pixel of the views, at least 1
};

struct DemoSummary {
    std::filesystem::path page;   // index.html
    std::filesystem::path scene;  // the scene before the bake, .glb
    std::filesystem::path baked;  // and after it
    BakeSummary bake;
    ValidateSummary validation;  // deep
    InspectSummary inspection;
    std::vector<RenderSummary> views;  // one a camera, the first with a triptych
    std::filesystem::path heights;     // a terrain, 16-bit .png
    std::filesystem::path terrain;     // and its grids, .fil
    GridsSummary grids;
    RenderSummary terrainView;  // traced from them
};

Result<DemoSummary> demo(const DemoOptions& options, const Executor& executor, ProgressSink& progress);

// The machine-readable result: one JSON object with what bake, validate, inspect and render would give.
std::string toJson(const DemoSummary& summary);

}  // namespace filigree::jobs
