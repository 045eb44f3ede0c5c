// The charts of a vq run.
#pragma once

#include "filigree/core/result.h"
#include "filigree/jobs/vq.h"
#include "filigree/report/chart.h"

#include <filesystem>
#include <string>
#include <vector>

namespace filigree::jobs {

// A chart and the file that it goes to.
struct NamedChart {
    std::string file;
    report::LineChart chart;
};

// Savings texture by texture, from the least to the greatest: figures 6, 7 and 10 of the paper.
std::vector<NamedChart> vqCharts(const VqSummary& summary);

// Writes charts and tables, with index.html around them and `pictures`, paths relative to the folder.
Status writeVqReport(const VqOptions& options, const VqSummary& summary,
                     const std::vector<std::string>& pictures);

}  // namespace filigree::jobs
