// From values to places along an axis, and the ticks that mark it.
#pragma once

#include <vector>

namespace filigree::report {

class Scale {
  public:
    // Covers [lo, hi], widened to whole ticks. A logarithmic scale needs 0 < lo <= hi.
    Scale(double lo, double hi, bool log);

    // A linear scale over exactly [lo, hi], whole numbers with a tick at each.
    static Scale whole(double lo, double hi);

    // 0 at the low end of the axis, 1 at the high end; beyond for values beyond.
    [[nodiscard]] double at(double value) const;
    [[nodiscard]] const std::vector<double>& ticks() const { return ticks_; }

  private:
    void makeLinear();
    void makeLog();

    double lo_;
    double hi_;
    bool log_;
    std::vector<double> ticks_;
};

}  // namespace filigree::report
