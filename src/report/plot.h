// What bar and line charts share: title, legend, axes and the rectangle that the data is drawn in.
#pragma once

#include "filigree/report/chart.h"

#include "report/scale.h"

#include <string>
#include <vector>

namespace filigree::report {

struct LegendEntry {
    std::string name;
    Colour colour;
    bool line = false;  // a stroke instead of a box
    bool dashed = false;
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
};

// A value on an axis, as text.
std::string axisText(const Axis& axis, double value);

}  // namespace filigree::report
