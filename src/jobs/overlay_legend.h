// What the colours of an overlay mean, and the strip below it that says so.
#pragma once

#include "filigree/micromap/state.h"

#include "jobs/canvas.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace filigree::jobs {

inline constexpr Colour overlayInk{20, 24, 28};

// Four colours that stay apart for colour-blind readers: known states are blue, unknown ones orange, and the
// opaque side is the lighter of each.
Colour stateColour(micromap::State state);
const char* stateName(micromap::State state);

// A line of text and the share of each state.
struct OverlayLegend {
    std::string title;
    std::array<double, 4> shares{};  // by State, of one
};

// The legend laid out for a picture `width` pixels wide.
class LegendStrip {
  public:
    LegendStrip(const OverlayLegend& legend, uint32_t width);

    [[nodiscard]] uint32_t height() const;
    void draw(Canvas& canvas, uint32_t top) const;

  private:
    struct Item {
        std::string text;
        micromap::State state;
        Pixel at;  // below the strip's top
    };

    std::string title_;
    double size_;  // of the text, pixels; everything is laid out in shares of it
    std::vector<Item> items_;
};

}  // namespace filigree::jobs
