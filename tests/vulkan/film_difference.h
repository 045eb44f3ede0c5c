// How far two pictures differ.
#pragma once

#include "filigree/trace/render.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <vector>

namespace filigree::tests {

// Pixels that differ by more than rounding.
inline std::vector<size_t> differingPixels(const trace::Film& a, const trace::Film& b) {
    const scene::ColourImage one = developed(a);
    const scene::ColourImage other = developed(b);
    std::vector<size_t> pixels;
    for (size_t k = 0; k < one.rgba.size(); k += 4) {
        int most = 0;
        for (size_t channel = 0; channel < 3; ++channel)
            most = std::max(most, std::abs(one.rgba[k + channel] - other.rgba[k + channel]));
        if (most > 1) pixels.push_back(k / 4);
    }
    return pixels;
}
inline size_t differing(const trace::Film& a, const trace::Film& b) {
    return differingPixels(a, b).size();
}

}  // namespace filigree::tests
