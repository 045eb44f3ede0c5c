#include "jobs/colour_ramp.h"

#include "filigree/report/number.h"

#include <algorithm>
#include <cmath>

namespace filigree::jobs {

const std::vector<Colour>& heatRamp() {
    static const std::vector<Colour> ramp{{0, 0, 4},      {51, 16, 104},  {129, 32, 116}, {203, 65, 76},
                                          {244, 124, 36}, {250, 190, 60}, {252, 255, 190}};
    return ramp;
}

// After ColorBrewer's YlOrRd, its pale end grey.
const std::vector<Colour>& surfaceRamp() {
    static const std::vector<Colour> ramp{
        {222, 226, 230}, {254, 217, 118}, {253, 141, 60}, {227, 26, 28}, {128, 0, 38}};
    return ramp;
}

double rampPlace(double amount, double end) {
    return std::sqrt(std::clamp(amount / end, 0.0, 1.0));
}

double rampEnd(double most) {
    if (!(most > 0)) return 1;
    const double power = std::pow(10.0, std::floor(std::log10(most)));
    for (const double factor : {1.0, 2.0, 4.0, 8.0}) {
        if (factor * power >= most * 0.9999) return factor * power;
    }
    return 10 * power;
}

report::ColourScale rampScale(const std::vector<Colour>& ramp, const std::string& title, double end,
                              const std::string& note) {
    report::ColourScale scale{title, ramp, {}, note};
    for (int quarter = 0; quarter <= 4; ++quarter)
        scale.marks.push_back({quarter / 4.0, report::formatCompact(end * quarter * quarter / 16)});
    return scale;
}

}  // namespace filigree::jobs
