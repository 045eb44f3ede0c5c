// How far two pictures differ.
#pragma once

#include "filigree/trace/render.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>

namespace filigree::tests {

// Pixels that differ by more than rounding.
inline size_t differing(const trace::Film& a, const trace::Film& b) {
    const scene::ColourImage one = developed(a);
    const scene::ColourImage other = developed(b);
    size_t count = 0;
    for (size_t k = 0; k < one.rgba.size(); k += 4) {
        int most = 0;
        for (size_t channel = 0; channel < 3; ++channel)
            most = std::max(most, std::abs(one.rgba[k + channel] - other.rgba[k + channel]));
        count += most > 1 ? 1 : 0;
    }
    return count;
}

}  // namespace filigree::tests
