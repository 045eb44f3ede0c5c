// The charts of a vq run.
#pragma once

#include "filigree/core/result.h"
#include "filigree/jobs/vq.h"
#include "filigree/report/chart.h"
#include "filigree/report/page.h"

#include "jobs/vq_picture.h"

#include <string>
#include <vector>

namespace filigree::jobs {

// A chart and the file that it goes to.
struct NamedChart {
    std::string file;
    report::LineChart chart;
};

// What shows one texture's first map: a file of its own, and an entry of the page.
struct VqPicture {
    std::string file;
    std::vector<uint8_t> png;
    report::Gallery::Item item;
};

Result<report::Gallery::Item> galleryItem(const VqTexture& texture, const VqPanels& panels);

// Savings texture by texture, from the least to the greatest: figures 6, 7 and 10 of the paper.
std::vector<NamedChart> vqCharts(const VqSummary& summary);

// Charts, tables and pictures for a page, which stays under about 10 MB: further pictures stand beside it
// only.
std::vector<report::Section> vqSections(const VqOptions& options, const VqSummary& summary,
                                        const std::vector<VqPicture>& pictures);

// Writes charts and tables, with index.html around them and the pictures.
Status writeVqReport(const VqOptions& options, const VqSummary& summary,
                     const std::vector<VqPicture>& pictures);

}  // namespace filigree::jobs
