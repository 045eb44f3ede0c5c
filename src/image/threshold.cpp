#include "filigree/image/threshold.h"

#include <limits>

namespace filigree::image {
namespace {

// The lowest texel value t in 0..65536, a multiple of 65535 / steps, for which passes(a, steps) holds.
template <class Passes>
uint32_t lowestPassing(uint32_t steps, Passes&& passes) {
    uint32_t low = 0;
    uint32_t high = steps + 1;
    while (low < high) {
        const uint32_t middle = (low + high) / 2;
        if (passes(middle)) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    return low > steps ? 65536 : low * (65535 / steps);
}

Threshold thresholdFor(uint32_t lowestOpaque, double exact, uint32_t steps) {
    const double step = 65535.0 / steps;
    const double highest = lowestOpaque;
    const double lowest = highest - step;
    if (lowestOpaque == 0) return {0, -1};
    if (exact > lowest && exact <= highest) return {lowestOpaque, exact};
    return {lowestOpaque, highest};
}

}  // namespace

std::vector<Threshold> thresholdsOf(const AlphaTest& test, double vertexAlpha, uint32_t steps) {
    const double factor = test.factor * vertexAlpha;
    const float floatFactor = static_cast<float>(test.factor) * static_cast<float>(vertexAlpha);
    if (test.mode == AlphaMode::blend) {
        AlphaTest one = test;
        one.mode = AlphaMode::mask;
        one.cutoff = 1;
        std::vector<Threshold> thresholds = thresholdsOf(one, vertexAlpha, steps);
        thresholds.push_back(factor > 0 ? Threshold{65535 / steps, std::numeric_limits<double>::min()}
                                        : Threshold{65536, 65536});
        return thresholds;
    }
    const double exact = factor > 0 ? test.cutoff * 65535 / factor : std::numeric_limits<double>::infinity();
    const uint32_t inDouble =
        lowestPassing(steps, [&](uint32_t a) { return a / double(steps) * factor >= test.cutoff; });
    const uint32_t inFloat = lowestPassing(steps, [&](uint32_t a) {
        return static_cast<float>(a) / static_cast<float>(steps) * floatFactor >=
               static_cast<float>(test.cutoff);
    });
    std::vector<Threshold> thresholds{thresholdFor(inDouble, exact, steps)};
    if (inFloat != inDouble) thresholds.push_back(thresholdFor(inFloat, exact, steps));
    return thresholds;
}

Threshold sideThreshold(const AlphaTest& test, double vertexAlpha, uint32_t steps) {
    AlphaTest mask = test;
    if (test.mode == AlphaMode::blend) mask.cutoff = 0.5;
    mask.mode = AlphaMode::mask;
    return thresholdsOf(mask, vertexAlpha, steps).front();
}

}  // namespace filigree::image
