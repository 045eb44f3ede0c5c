// Colours for amounts: what pictures show and what their scales say of it.
#pragma once

#include "filigree/report/colour_scale.h"

#include "jobs/canvas.h"

#include <string>
#include <vector>

namespace filigree::jobs {

// From none to the most. The first is dark to light, for whole pictures; the second pale to dark, for
// surfaces that light and shade shall model.
const std::vector<Colour>& heatRamp();
const std::vector<Colour>& surfaceRamp();

// Where an amount stands on a scale that ends at `end`: the root of its share, so that little shows beside
// much.
double rampPlace(double amount, double end);

// The least of 1, 2, 4 and 8 times a power of ten that is not below `most`, so that quarters are round; 1
// for none.
double rampEnd(double most);

// With marks at the quarters of the bar.
report::ColourScale rampScale(const std::vector<Colour>& ramp, const std::string& title, double end,
                              const std::string& note);

}  // namespace filigree::jobs
