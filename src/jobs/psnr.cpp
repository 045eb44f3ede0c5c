#include "jobs/psnr.h"

#include <cassert>
#include <cmath>
#include <limits>

namespace filigree::jobs {

double psnr(const scene::ColourImage& a, const scene::ColourImage& b) {
    assert(a.rgba.size() == b.rgba.size());
    uint64_t squares = 0;
    for (size_t k = 0; k < a.rgba.size(); ++k) {
        if (k % 4 == 3) continue;
        const int difference = int{a.rgba[k]} - int{b.rgba[k]};
        squares += static_cast<uint64_t>(difference * difference);
    }
    if (squares == 0) return std::numeric_limits<double>::infinity();
    const double mean = static_cast<double>(squares) / (0.75 * static_cast<double>(a.rgba.size()));
    return 10 * std::log10(255.0 * 255.0 / mean);
}

}  // namespace filigree::jobs
