#include "report/scale.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace filigree::report {

namespace {

// The step of 1, 2 or 5 times a power of ten that cuts `span` into at most about six parts.
double niceStep(double span) {
    const double rough = span / 6;
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    for (const double factor : {1.0, 2.0, 5.0}) {
        if (factor * power >= rough * 0.999) return factor * power;
    }
    return 10 * power;
}

}  // namespace

Scale::Scale(double lo, double hi, bool log) : lo_(lo), hi_(hi), log_(log) {
    assert(lo <= hi && (!log || lo > 0));
    if (log_) {
        makeLog();
    } else {
        makeLinear();
    }
}

Scale Scale::whole(double lo, double hi) {
    Scale scale(lo, std::max(hi, lo + 1), false);
    scale.lo_ = lo;
    scale.hi_ = std::max(hi, lo + 1);
    scale.ticks_.clear();
    for (double tick = lo; tick <= scale.hi_; ++tick) scale.ticks_.push_back(tick);
    return scale;
}

void Scale::makeLinear() {
    if (hi_ == lo_) hi_ = lo_ + std::max(1.0, std::abs(lo_));
    const double step = niceStep(hi_ - lo_);
    const double first = std::floor(lo_ / step + 1e-9);
    const double last = std::ceil(hi_ / step - 1e-9);
    lo_ = first * step;
    hi_ = last * step;
    for (double k = first; k <= last; ++k) ticks_.push_back(k * step);
}

// Whole decades, every n-th where there are many.
void Scale::makeLog() {
    const double first = std::floor(std::log10(lo_) + 1e-9);
    const double last = std::max(first + 1, std::ceil(std::log10(hi_) - 1e-9));
    lo_ = std::pow(10.0, first);
    hi_ = std::pow(10.0, last);
    const double step = std::ceil((last - first) / 8);
    for (double k = first; k <= last; k += step) ticks_.push_back(std::pow(10.0, k));
}

double Scale::at(double value) const {
    if (!log_) return (value - lo_) / (hi_ - lo_);
    return (std::log10(value) - std::log10(lo_)) / (std::log10(hi_) - std::log10(lo_));
}

}  // namespace filigree::report
