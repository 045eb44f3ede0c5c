// What the demo's micromaps take in every encoding, and what opacity squares would save.
#pragma once

#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/report/page.h"

#include <filesystem>
#include <vector>

namespace filigree::jobs {

// Compares and measures `scene`; writes compare.html and vq/index.html into `folder`, and gives the sections
// that show what matters of them.
Result<std::vector<report::Section>> measureDemo(const std::filesystem::path& scene,
                                                 const std::filesystem::path& folder,
                                                 const Executor& executor, ProgressSink& progress);

}  // namespace filigree::jobs
