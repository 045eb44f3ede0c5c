// One page on a conversion to grids: what they look like, what they take and how far they are off.
#pragma once

#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/jobs/grids.h"
#include "filigree/report/page.h"

#include "jobs/grid_views.h"

namespace filigree::jobs {

// Renders the pictures and lays all out.
Result<report::Page> makeGridsPage(const GridsOptions& options, const GridsSummary& summary,
                                   const GridViewSource& source, const Executor& executor,
                                   ProgressSink& progress);

}  // namespace filigree::jobs
