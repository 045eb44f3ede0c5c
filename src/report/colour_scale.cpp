#include "filigree/report/colour_scale.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace filigree::report {
namespace {

constexpr double scaleTextSize = 12;
constexpr double barTop = 24;
constexpr double barHeight = 14;
constexpr unsigned slices = 96;

uint8_t between(uint8_t a, uint8_t b, double share) {
    return static_cast<uint8_t>(std::lround(a + share * (b - a)));
}

// The first and the last mark end where the bar does.
Anchor anchorOf(const ColourScale::Mark& mark) {
    if (mark.at <= 0) return Anchor::start;
    return mark.at >= 1 ? Anchor::end : Anchor::middle;
}

}  // namespace

Colour colourAt(const ColourScale& scale, double place) {
    assert(scale.colours.size() >= 2);
    const double at = std::clamp(place, 0.0, 1.0) * static_cast<double>(scale.colours.size() - 1);
    const size_t below = std::min(static_cast<size_t>(at), scale.colours.size() - 2);
    const Colour a = scale.colours[below];
    const Colour b = scale.colours[below + 1];
    const double share = at - static_cast<double>(below);
    return {between(a.r, b.r, share), between(a.g, b.g, share), between(a.b, b.b, share)};
}

Drawing layOut(const ColourScale& scale, double width) {
    const double bar = width - 2;
    Drawing drawing{width, barTop + barHeight + 20 + (scale.note.empty() ? 0 : 18), scale.title, {}};
    const auto addText = [&](double x, double y, const std::string& text, Anchor anchor, Ink ink) {
        drawing.shapes.emplace_back(Text{x, y, text, scaleTextSize, anchor, ink, false, false});
    };
    addText(1, 14, scale.title, Anchor::start, Ink::text);
    for (unsigned k = 0; k < slices; ++k) {
        // Each reaches below the next, so that no gap shows between them.
        const double left = 1 + bar * k / slices;
        const double right = 1 + bar * std::min(k + 1.5, double{slices}) / slices;
        const Colour colour = colourAt(scale, (k + 0.5) / slices);
        drawing.shapes.emplace_back(Rect{left, barTop, right - left, barHeight, colour, "", false});
    }
    for (const auto& mark : scale.marks) {
        const double x = 1 + bar * mark.at;
        drawing.shapes.emplace_back(Line{x, barTop, x, barTop + barHeight + 3, Ink::faint, 1});
        addText(x, barTop + barHeight + 16, mark.text, anchorOf(mark), Ink::faint);
    }
    if (!scale.note.empty()) addText(1, barTop + barHeight + 34, scale.note, Anchor::start, Ink::faint);
    return drawing;
}

}  // namespace filigree::report
