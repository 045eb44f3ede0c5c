// The demo's terrain: a heightfield made in code, compressed, and traced from its .fil.
#pragma once

#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/jobs/grids.h"
#include "filigree/jobs/render.h"
#include "filigree/report/page.h"

#include <filesystem>
#include <string>
#include <vector>

namespace filigree::jobs {

struct DemoTerrain {
    std::filesystem::path heights;  // 16-bit grey PNG
    std::filesystem::path grids;    // .fil
    GridsSummary conversion;
    RenderSummary render;
    std::vector<std::string> files;  // pictures in the folder
    report::Section section;
};

Result<DemoTerrain> drawDemoTerrain(const std::filesystem::path& folder, unsigned samples,
                                    const Executor& executor, ProgressSink& progress);

}  // namespace filigree::jobs
