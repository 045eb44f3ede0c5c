#include "report/plot.h"

#include "filigree/report/number.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace filigree::report {

namespace {

constexpr double titleSize = 15;
constexpr double textSize = 12;

std::string labelOf(const Axis& axis) {
    return axis.unit.empty() ? axis.label : axis.label + " (" + axis.unit + ")";
}

// `text` cut to `room` units with an ellipsis, without breaking a UTF-8 character.
std::string shortened(std::string text, double room) {
    if (textWidth(text, textSize) <= room) return text;
    while (!text.empty() && textWidth(text + "...", textSize) > room) {
        while (!text.empty() && (static_cast<uint8_t>(text.back()) & 0xC0) == 0x80) text.pop_back();
        if (!text.empty()) text.pop_back();
    }
    return text + "...";
}

// Left of an entry's name, at the height of its text.
Shape legendShape(const LegendEntry& entry, double x, double top) {
    switch (entry.mark) {
        case LegendMark::line:
        case LegendMark::dashed:
            return Polyline{
                {{x, top + 2}, {x + 16, top + 2}}, entry.colour, 3, entry.mark == LegendMark::dashed};
        case LegendMark::dot:
        case LegendMark::ring:
            return Dot{x + 8, top + 2, 5, entry.colour, "", entry.mark == LegendMark::ring};
        case LegendMark::box:
            break;
    }
    return Rect{x + 1, top - 4, 12, 12, entry.colour, ""};
}

}  // namespace

std::string axisText(const Axis& axis, double value) {
    if (!axis.share) return formatCompact(value);
    return formatCompact(value * 100) + " %";
}

bool isDrawable(const Axis& axis, double value) {
    return std::isfinite(value) && (!axis.log || value > 0);
}

std::vector<TickLabel> scaleTicks(const Axis& axis, const Scale& scale) {
    std::vector<TickLabel> ticks;
    for (const double tick : scale.ticks()) ticks.push_back({scale.at(tick), axisText(axis, tick)});
    return ticks;
}

Plot::Plot(double width, double height, const std::string& title) : right(width - 16), bottom(height - 12) {
    drawing.width = width;
    drawing.height = height;
    drawing.title = title;
    if (title.empty()) return;
    drawing.shapes.push_back(Text{left, top + 6, shortened(title, (right - left) * textSize / titleSize),
                                  titleSize, Anchor::start, Ink::text, true, false});
    top += 20;
}

void Plot::addLegend(const std::vector<LegendEntry>& entries) {
    if (entries.empty()) return;
    double x = left;
    for (const LegendEntry& e : entries) {
        const double width = 21 + textWidth(e.name, textSize) + 14;
        if (x > left && x + width > right) {
            x = left;
            top += 18;
        }
        drawing.shapes.push_back(legendShape(e, x, top));
        drawing.shapes.push_back(Text{x + 21, top + 6, shortened(e.name, right - x - 21), textSize,
                                      Anchor::start, Ink::text, false, false});
        x += width;
    }
    top += 20;
}

void Plot::addYAxis(const Axis& axis, const Scale& scale, const Axis& xAxis) {
    double widest = 0;
    for (const double tick : scale.ticks())
        widest = std::max(widest, textWidth(axisText(axis, tick), textSize));
    const bool labelled = !labelOf(axis).empty();
    top += 8;
    hasXLabel_ = !labelOf(xAxis).empty();
    bottom -= 20 + (hasXLabel_ ? 20 : 0);
    left += widest + 8 + (labelled ? 20 : 0);
    for (const double tick : scale.ticks()) {
        const double y = yOf(scale.at(tick));
        drawing.shapes.push_back(Line{left, y, right, y, Ink::grid, 1});
        drawing.shapes.push_back(
            Text{left - 8, y + 4, axisText(axis, tick), textSize, Anchor::end, Ink::faint, false, false});
    }
    drawing.shapes.push_back(Line{left, bottom, right, bottom, Ink::faint, 1});
    if (labelled) {
        drawing.shapes.push_back(Text{26, (top + bottom) / 2, shortened(labelOf(axis), bottom - top),
                                      textSize, Anchor::middle, Ink::text, false, true});
    }
    if (hasXLabel_) {
        drawing.shapes.push_back(Text{(left + right) / 2, bottom + 38, labelOf(xAxis), textSize,
                                      Anchor::middle, Ink::text, false, false});
    }
}

// Long names are cut where a slot has room for some of them; short ones (bins) stand in two rows or are
// thinned out.
void Plot::addXTicks(const std::vector<TickLabel>& ticks, double room) {
    double widest = 0;
    for (const TickLabel& tick : ticks) widest = std::max(widest, textWidth(tick.text, textSize) + 6);
    const bool cut = room >= 60;
    const size_t every = cut || room <= 0 ? 1 : static_cast<size_t>(std::max(1.0, std::ceil(widest / room)));
    // Two rows hold them all where nothing stands below.
    const bool inRows = every == 2 && !hasXLabel_;
    for (size_t i = 0; i < ticks.size(); i += inRows ? 1 : every) {
        const std::string text = cut ? shortened(ticks[i].text, room - 6) : ticks[i].text;
        const double half = textWidth(text, textSize) / 2;
        const double x = std::min(xOf(ticks[i].at), drawing.width - half - 2);
        const double y = bottom + (inRows && i % 2 == 1 ? 31 : 18);
        drawing.shapes.push_back(Text{x, y, text, textSize, Anchor::middle, Ink::faint, false, false});
    }
}

void Plot::addNoData() {
    drawing.shapes.push_back(Text{drawing.width / 2, drawing.height / 2, "no data", textSize, Anchor::middle,
                                  Ink::faint, false, false});
}

}  // namespace filigree::report
