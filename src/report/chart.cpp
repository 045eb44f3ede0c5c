#include "filigree/report/chart.h"

#include "filigree/report/number.h"

#include "report/plot.h"
#include "report/scale.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <optional>

namespace filigree::report {

namespace {

constexpr double labelSize = 11;

double finite(double value) {
    return std::isfinite(value) ? value : 0;
}

// ---- bars ----

Range barRange(const BarChart& chart) {
    Range range;
    for (size_t c = 0; c < chart.categories.size(); ++c) {
        double sum = 0;
        for (const auto& series : chart.series) {
            assert(series.values.size() == chart.categories.size());
            const double value = finite(series.values[c]);
            sum += value;
            if (!chart.stacked && isDrawable(chart.y, value)) range.take(value);
        }
        if (chart.stacked) range.take(sum);
    }
    return range;
}

// Bars start at zero; on a logarithmic axis a decade below the least, so that it still shows.
Scale barScale(const BarChart& chart, Range range) {
    if (!chart.y.log) return {std::min(0.0, range.lo), std::max(0.0, range.hi), false};
    return {range.lo * 0.99, range.hi, true};
}

std::vector<LegendEntry> barLegend(const BarChart& chart) {
    std::vector<LegendEntry> entries;
    for (const auto& series : chart.series) {
        if (!series.name.empty() && series.colours.empty()) entries.push_back({series.name, series.colour});
    }
    return entries;
}

class BarPainter {
  public:
    BarPainter(const BarChart& chart, const Scale& scale, Plot& plot)
        : chart_(chart), scale_(scale), plot_(plot) {
        slot_ = (plot.right - plot.left) / static_cast<double>(chart.categories.size());
        const double bars = chart.stacked ? 1 : static_cast<double>(chart.series.size());
        width_ = std::min(slot_ * 0.8 / bars, 72.0);
        margin_ = (slot_ - width_ * bars) / 2;
    }

    void paint() {
        for (size_t c = 0; c < chart_.categories.size(); ++c) {
            double base = 0;
            for (size_t s = 0; s < chart_.series.size(); ++s) {
                const double value = finite(chart_.series[s].values[c]);
                const double beside = chart_.stacked ? 0 : width_ * static_cast<double>(s);
                paintBar(c, s, plot_.left + slot_ * static_cast<double>(c) + margin_ + beside, base, value);
                if (chart_.stacked) base += value;
            }
        }
    }

    [[nodiscard]] double slot() const { return slot_; }

  private:
    void paintBar(size_t c, size_t s, double x, double base, double value) {
        if (value == 0 || !isDrawable(chart_.y, value)) return;
        const double from = chart_.y.log ? plot_.bottom : plot_.yOf(scale_.at(base));
        const double to = plot_.yOf(scale_.at(base + value));
        const auto& series = chart_.series[s];
        const std::string text = axisText(chart_.y, value);
        const std::string who = series.name.empty() ? "" : series.name + ", ";
        plot_.drawing.shapes.push_back(Rect{x, std::min(from, to), width_, std::abs(from - to),
                                            series.colours.empty() ? series.colour : series.colours[c],
                                            who + chart_.categories[c] + ": " + text});
        const double room = chart_.series.size() == 1 ? slot_ : width_;
        if (chart_.labels && !chart_.stacked && textWidth(text, labelSize) <= room) {
            plot_.drawing.shapes.push_back(Text{x + width_ / 2, std::min(from, to) - 4, text, labelSize,
                                                Anchor::middle, Ink::text, false, false});
        }
    }

    const BarChart& chart_;
    const Scale& scale_;
    Plot& plot_;
    double slot_ = 0;
    double width_ = 0;
    double margin_ = 0;
};

std::vector<TickLabel> categoryTicks(const BarChart& chart) {
    std::vector<TickLabel> ticks;
    const auto count = static_cast<double>(chart.categories.size());
    for (size_t c = 0; c < chart.categories.size(); ++c) {
        ticks.push_back({(static_cast<double>(c) + 0.5) / count, chart.categories[c]});
    }
    return ticks;
}

// ---- lines ----

std::pair<Range, Range> lineRanges(const LineChart& chart) {
    Range x;
    Range y;
    for (const auto& series : chart.series) {
        for (const auto& [px, py] : series.points) {
            if (!isDrawable(chart.x, px) || !isDrawable(chart.y, py)) continue;
            x.take(px);
            y.take(py);
        }
    }
    if (!y.empty() && !chart.y.log) y.take(0);
    return {x, y};
}

std::vector<LegendEntry> lineLegend(const LineChart& chart) {
    std::vector<LegendEntry> entries;
    for (const auto& series : chart.series) {
        if (!series.name.empty())
            entries.push_back(
                {series.name, series.colour, series.dashed ? LegendMark::dashed : LegendMark::line});
    }
    return entries;
}

constexpr double mostWholeTicks = 16;

// Dots of longer series would run into each other.
constexpr size_t mostDots = 60;

void paintLine(const LineChart& chart, const LineChart::Series& series, const Scale& xs, const Scale& ys,
               Plot& plot) {
    Polyline line{{}, series.colour, 2, series.dashed};
    std::vector<Shape> dots;
    const bool hasDots = series.points.size() <= mostDots;
    for (const auto& [px, py] : series.points) {
        if (!isDrawable(chart.x, px) || !isDrawable(chart.y, py)) continue;
        const double x = plot.xOf(xs.at(px));
        const double y = plot.yOf(ys.at(py));
        line.points.emplace_back(x, y);
        if (!hasDots) continue;
        const std::string who = series.name.empty() ? "" : series.name + ", ";
        dots.emplace_back(
            Dot{x, y, 3, series.colour, who + axisText(chart.x, px) + ": " + axisText(chart.y, py)});
    }
    plot.drawing.shapes.emplace_back(std::move(line));
    plot.drawing.shapes.insert(plot.drawing.shapes.end(), dots.begin(), dots.end());
}

}  // namespace

// After Okabe and Ito, "Color universal design" (2008), with the yellow darkened so that it holds on white.
Colour seriesColour(size_t index) {
    constexpr std::array<Colour, 8> colours = {{{0, 114, 178},
                                                {230, 159, 0},
                                                {0, 158, 115},
                                                {213, 94, 0},
                                                {86, 180, 233},
                                                {204, 121, 167},
                                                {200, 180, 20},
                                                {128, 128, 128}}};
    return colours[index % colours.size()];
}

Drawing layOut(const BarChart& chart, double width, double height) {
    assert(!(chart.stacked && chart.y.log));
    Plot plot(width, height, chart.title);
    const Range range = barRange(chart);
    if (range.empty()) {
        plot.addNoData();
        return std::move(plot.drawing);
    }
    const Scale scale = barScale(chart, range);
    plot.addLegend(barLegend(chart));
    plot.addYAxis(chart.y, scale, chart.x);
    BarPainter painter(chart, scale, plot);
    painter.paint();
    plot.addXTicks(categoryTicks(chart), painter.slot());
    return std::move(plot.drawing);
}

Drawing layOut(const LineChart& chart, double width, double height) {
    Plot plot(width, height, chart.title);
    const auto [xRange, yRange] = lineRanges(chart);
    if (xRange.empty()) {
        plot.addNoData();
        return std::move(plot.drawing);
    }
    const bool few = chart.x.whole && !chart.x.log && xRange.hi - xRange.lo <= mostWholeTicks;
    const Scale xs = few ? Scale::whole(xRange.lo, xRange.hi) : Scale(xRange.lo, xRange.hi, chart.x.log);
    const Scale ys(yRange.lo, yRange.hi, chart.y.log);
    plot.addLegend(lineLegend(chart));
    plot.addYAxis(chart.y, ys, chart.x);
    const std::vector<TickLabel> ticks = scaleTicks(chart.x, xs);
    plot.addXTicks(ticks, 0);
    for (const auto& series : chart.series) paintLine(chart, series, xs, ys, plot);
    return std::move(plot.drawing);
}

}  // namespace filigree::report
