// The demo's pictures, and what their alpha tests cost.
#pragma once

#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/jobs/render.h"
#include "filigree/report/page.h"

#include <filesystem>
#include <string>
#include <vector>

namespace filigree::jobs {

struct DemoViews {
    std::vector<RenderSummary> renders;  // one a camera
    std::vector<std::string> files;      // pictures in the folder
    report::Section section;
};

// A PNG in the page's folder, with the command that made it.
Result<report::Figure> figureOf(const std::filesystem::path& file, const std::string& alt,
                                const std::string& caption, const std::string& command);

// Renders a baked scene from each of its cameras into `folder`, with `samples` a pixel; the first with its
// alpha tests beside it.
Result<DemoViews> drawDemoViews(const std::filesystem::path& baked, size_t cameras, unsigned samples,
                                const std::filesystem::path& folder, const Executor& executor,
                                ProgressSink& progress);

}  // namespace filigree::jobs
