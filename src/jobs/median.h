// The middle of several measurements.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <span>
#include <vector>

namespace filigree::jobs {

// Of an even number the mean of the two in the middle. At least one.
inline double median(std::vector<double> values) {
    assert(!values.empty());
    std::ranges::sort(values);
    const size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

// Of values[k] / others[k].
inline double medianRatio(std::span<const double> values, std::span<const double> others) {
    assert(values.size() == others.size());
    std::vector<double> ratios;
    for (size_t k = 0; k < values.size(); ++k) ratios.push_back(values[k] / others[k]);
    return median(std::move(ratios));
}

}  // namespace filigree::jobs
