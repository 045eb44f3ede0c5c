// A map beside what each encoding makes of it, as figure 9 of Fenney and Ozkan 2023.
#pragma once

#include "filigree/report/page.h"

#include "jobs/canvas.h"
#include "jobs/vq_maps.h"
#include "jobs/vq_measure.h"

#include <array>
#include <string>
#include <vector>

namespace filigree::jobs {

struct VqPanel {
    Canvas picture;  // of a square a pixel a region
    std::string caption;
    bool isSquare = false;
};

struct VqPanels {
    VqPanel alpha;
    // Of 16 and of 32 regions a side: the square, it with each vector turned as the best encoder stores it,
    // and it after the paper's, the best and the extended encoder.
    std::array<std::vector<VqPanel>, 2> rows;
};

// The first map of the input. Regions that were known and are mixed now stand out.
VqPanels drawPanels(const VqInput& input, const VqMap& map);

// All panels in one picture.
Canvas drawSheet(const VqPanels& panels);

// What the colours mean.
report::Legend panelLegend();

}  // namespace filigree::jobs
