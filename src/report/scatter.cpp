#include "filigree/report/chart.h"

#include "report/plot.h"
#include "report/scale.h"

#include <utility>

namespace filigree::report {
namespace {

constexpr double scatterRadius = 5;

using Points = std::vector<ScatterChart::Point>;

Points drawable(const ScatterChart& chart, const ScatterChart::Series& series) {
    Points points;
    for (const auto& point : series.points) {
        if (isDrawable(chart.x, point.x) && isDrawable(chart.y, point.y)) points.push_back(point);
    }
    return points;
}

// "lattice, terrain 1025: 0.56, 2.1".
std::string hintOf(const ScatterChart& chart, const std::string& series, const ScatterChart::Point& point) {
    std::string hint = series;
    if (!hint.empty() && !point.name.empty()) hint += ", ";
    hint += point.name;
    if (!hint.empty()) hint += ": ";
    return hint + axisText(chart.x, point.x) + ", " + axisText(chart.y, point.y);
}

}  // namespace

Drawing layOut(const ScatterChart& chart, double width, double height) {
    Plot plot(width, height, chart.title);
    Range x;
    Range y;
    std::vector<LegendEntry> legend;
    for (const auto& series : chart.series) {
        for (const auto& point : drawable(chart, series)) {
            x.take(point.x);
            y.take(point.y);
        }
        if (!series.name.empty())
            legend.push_back(
                {series.name, series.colour, series.hollow ? LegendMark::ring : LegendMark::dot});
    }
    if (x.empty()) {
        plot.addNoData();
        return std::move(plot.drawing);
    }
    if (!chart.x.log) x.take(0);
    if (!chart.y.log) y.take(0);
    const Scale xs(x.lo, x.hi, chart.x.log);
    const Scale ys(y.lo, y.hi, chart.y.log);
    plot.addLegend(legend);
    plot.addYAxis(chart.y, ys, chart.x);
    plot.addXTicks(scaleTicks(chart.x, xs), 0);
    for (const auto& series : chart.series) {
        for (const auto& point : drawable(chart, series)) {
            plot.drawing.shapes.emplace_back(Dot{plot.xOf(xs.at(point.x)), plot.yOf(ys.at(point.y)),
                                                 scatterRadius, series.colour,
                                                 hintOf(chart, series.name, point), series.hollow});
        }
    }
    return std::move(plot.drawing);
}

}  // namespace filigree::report
