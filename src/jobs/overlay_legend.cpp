#include "jobs/overlay_legend.h"

#include "filigree/report/number.h"

#include "jobs/lettering.h"

#include <algorithm>
#include <cmath>

namespace filigree::jobs {
namespace {

using micromap::State;

// In text sizes.
constexpr double margin = 0.8;
constexpr double rowHeight = 1.7;
constexpr double swatch = 1;

}  // namespace

Colour stateColour(State state) {
    constexpr std::array<Colour, 4> colours = {{{0, 90, 170}, {110, 200, 245}, {205, 70, 0}, {250, 190, 40}}};
    return colours[static_cast<size_t>(state)];
}

const char* stateName(State state) {
    constexpr std::array<const char*, 4> names = {"transparent", "opaque", "unknown-transparent",
                                                  "unknown-opaque"};
    return names[static_cast<size_t>(state)];
}

// As many states in a row as fit.
LegendStrip::LegendStrip(const OverlayLegend& legend, uint32_t width)
    : title_(legend.title), size_(std::clamp(width / 70.0, 16.0, 34.0)) {
    const double left = margin * size_;
    Pixel at{left, (margin + rowHeight) * size_};
    for (size_t s = 0; s < legend.shares.size(); ++s) {
        const auto state = static_cast<State>(s);
        const std::string text = std::string(stateName(state)) + " " + report::formatShare(legend.shares[s]);
        const double needed = (1.5 * swatch + 1.5 * margin) * size_ + letteringWidth(text, size_);
        if (at.x > left && at.x + needed > width) at = {left, at.y + rowHeight * size_};
        items_.push_back({text, state, at});
        at.x += needed;
    }
}

uint32_t LegendStrip::height() const {
    return static_cast<uint32_t>(std::ceil(items_.back().at.y + (swatch + margin) * size_));
}

void LegendStrip::draw(Canvas& canvas, uint32_t top) const {
    canvas.fillRect(0, top, canvas.width(), height(), {255, 255, 255});
    const double baseline = 0.85 * size_;  // below the top of a row
    drawText(canvas, title_, {margin * size_, top + margin * size_ + baseline}, size_, report::Anchor::start,
             overlayInk, true);
    for (const Item& item : items_) {
        const double y = top + item.at.y;
        const double side = swatch * size_;
        canvas.fillRect(item.at.x, y, side, side, overlayInk);
        canvas.fillRect(item.at.x + 1, y + 1, side - 2, side - 2, stateColour(item.state));
        drawText(canvas, item.text, {item.at.x + 1.5 * side, y + baseline}, size_, report::Anchor::start,
                 overlayInk);
    }
}

}  // namespace filigree::jobs
