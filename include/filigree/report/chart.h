// Bar charts, histograms, line charts and scatter charts.
#pragma once

#include "filigree/report/drawing.h"

#include <string>
#include <utility>
#include <vector>

namespace filigree::report {

struct Axis {
    std::string label;
    std::string unit{};  // shown after the label; empty for none
    bool log = false;    // logarithmic; values that are not positive are then left out
    bool share = false;  // values are shares of one and show as percent
    bool whole = false;  // of a line chart's x: whole numbers, each with a tick where they are few
};

// A colour for the series `index` of a chart: eight that stay apart for colour-blind readers, on light and
// dark.
Colour seriesColour(size_t index);

// Bars in groups: one group a category, one bar a series, beside or on top of each other. A histogram is a
// bar chart of one series whose categories are its bins.
struct BarChart {
    struct Series {
        std::string name;            // in the legend; a lone series without a name has no legend
        std::vector<double> values;  // [category_count]; not finite counts as 0
        Colour colour = seriesColour(0);
        std::vector<Colour> colours{};  // [category_count], one a bar; empty for `colour` throughout
    };
    std::string title;
    Axis x;
    Axis y;
    std::vector<std::string> categories;
    std::vector<Series> series;
    bool stacked = false;  // needs a linear y axis
    bool labels = true;    // the value above each bar where there is room; stacked bars have none
};

// Points of a series show as dots unless they are very many.
struct LineChart {
    struct Series {
        std::string name;
        std::vector<std::pair<double, double>> points;  // (x, y) by rising x; points not finite are left out
        Colour colour = seriesColour(0);
        bool dashed = false;
    };
    std::string title;
    Axis x;
    Axis y;
    std::vector<Series> series;
};

// Dots by two measures.
struct ScatterChart {
    struct Point {
        double x = 0;
        double y = 0;
        std::string name{};  // on hover, after the series'; empty for none
    };
    struct Series {
        std::string name;
        std::vector<Point> points;  // those not finite are left out
        Colour colour = seriesColour(0);
        bool hollow = false;  // rings, to tell more series apart than there are colours
    };
    std::string title;
    Axis x;
    Axis y;
    std::vector<Series> series;
};

// The chart as a drawing `width` units wide. A chart without data says "no data".
Drawing layOut(const BarChart& chart, double width = 640, double height = 360);
Drawing layOut(const LineChart& chart, double width = 640, double height = 360);
Drawing layOut(const ScatterChart& chart, double width = 640, double height = 360);

}  // namespace filigree::report
