// One page on compressed grids against Embree.
#pragma once

#include "filigree/jobs/bench_grids.h"
#include "filigree/report/page.h"

namespace filigree::jobs {

report::Page benchGridsPage(const BenchGridsOptions& options, const BenchGridsSummary& summary);

}  // namespace filigree::jobs
