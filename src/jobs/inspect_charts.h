// Histograms and tables of inspected textures.
#pragma once

#include "filigree/jobs/inspect.h"
#include "filigree/report/chart.h"
#include "filigree/report/table.h"

#include <string>
#include <vector>

namespace filigree::jobs {

report::BarChart levelChart(const std::vector<InspectedTexture>& textures);
report::BarChart sharingChart(const std::vector<InspectedTexture>& textures);
report::BarChart stateChart(const std::vector<InspectedTexture>& textures);
report::BarChart overlapChart(const std::vector<InspectedTexture>& textures);
report::Table textureTable(const std::vector<InspectedTexture>& textures);

// Texture area, micro-triangles and whole triangles of each state.
report::Table stateTable(const std::vector<InspectedTexture>& textures);

}  // namespace filigree::jobs
