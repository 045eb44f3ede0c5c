// One page on the speed of rays with each way to test alpha.
#pragma once

#include "filigree/jobs/bench_trace.h"
#include "filigree/report/page.h"

namespace filigree::jobs {

report::Page benchTracePage(const BenchTraceOptions& options, const BenchTraceSummary& summary);

}  // namespace filigree::jobs
