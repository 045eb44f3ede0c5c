// What bar and line charts share: title, legend, axes and the rectangle that the data is drawn in.
#pragma once

#include "filigree/report/chart.h"

#include "report/scale.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace filigree::report {

enum class LegendMark : uint8_t { box, line, dashed, dot, ring };
struct LegendEntry {
    std::string name;
    Colour colour;
    LegendMark mark = LegendMark::box;
};

// A tick of the horizontal axis: its place in [0, 1] and its text.
struct TickLabel {
    double at = 0;
    std::string text;
};

// Lays out everything around the data; the chart then draws into [left, right] x [top, bottom].
class Plot {
  public:
    Plot(double width, double height, const std::string& title);

    // Draws title and legend, then the axes; call in this order.
    void addLegend(const std::vector<LegendEntry>& entries);
    void addYAxis(const Axis& axis, const Scale& scale, const Axis& xAxis);
    void addXTicks(const std::vector<TickLabel>& ticks, double room);
    void addNoData();

    [[nodiscard]] double xOf(double share) const { return left + share * (right - left); }
    [[nodiscard]] double yOf(double share) const { return bottom - share * (bottom - top); }

    double left = 16;
    double right;
    double top = 16;
    double bottom;
    Drawing drawing;

  private:
    bool hasXLabel_ = false;
};

// A value on an axis, as text.
std::string axisText(const Axis& axis, double value);

// The least and the greatest of some values.
struct Range {
    double lo = INFINITY;
    double hi = -INFINITY;
    void take(double value) {
        lo = std::min(lo, value);
        hi = std::max(hi, value);
    }
    [[nodiscard]] bool empty() const { return lo > hi; }
};

bool isDrawable(const Axis& axis, double value);

// The ticks of a scale with their texts.
std::vector<TickLabel> scaleTicks(const Axis& axis, const Scale& scale);

}  // namespace filigree::report
