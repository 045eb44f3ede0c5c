// What inspect and demo share: measuring a scene's micromaps and showing them as sections of a page.
#pragma once

#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/jobs/inspect.h"
#include "filigree/report/page.h"
#include "filigree/scene/scene.h"

#include "jobs/inspect_view.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace filigree::jobs {

struct Inspection {
    InspectSummary summary;  // without the page
    std::vector<report::Section> sections;
};

// Measures and draws the micromaps of `scene`; writes still pictures into `folder`, which exists. `command`
// is what figures say they were made by.
Result<Inspection> inspectScene(const scene::Scene& scene, const std::filesystem::path& folder,
                                const std::string& command, const ViewBudget& budget,
                                const Executor& executor, ProgressSink& progress);

// Makes `folder` and all above it where missing.
Status makeFolder(const std::filesystem::path& folder);

// A file name of plain characters.
std::string plainName(const std::string& name);

}  // namespace filigree::jobs
