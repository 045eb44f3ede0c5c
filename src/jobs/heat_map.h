// Pictures of what pixels cost, with their scale.
#pragma once

#include "filigree/report/colour_scale.h"
#include "filigree/scene/scene.h"

#include "jobs/canvas.h"

#include <cstdint>
#include <span>
#include <string_view>

namespace filigree::jobs {

// Counts of each pixel, of all its samples together.
struct HeatSource {
    std::string_view what;           // "alpha tests a sample"
    std::span<const uint32_t> sums;  // [width * height], one at least not absent
    uint32_t width = 0;              // pixels
    uint32_t height = 0;
    unsigned samples = 1;

    // The sum of a pixel that shows nothing and counts for nothing.
    static constexpr uint32_t absent = UINT32_MAX;
    [[nodiscard]] double at(size_t pixel) const { return static_cast<double>(sums[pixel]) / samples; }
    [[nodiscard]] double mean() const;
    [[nodiscard]] double maximum() const;
};

// Where a scale ends: all but a thousandth of the pixels are below.
double heatEnd(const HeatSource& source);

// The counts a sample in colour, and below them the scale, their mean and maximum.
Canvas heatMap(const HeatSource& source);

// The same in parts, for pages; a pixel is a pixel.
struct HeatPanel {
    Canvas picture;
    report::ColourScale scale;
};
HeatPanel heatPanel(const HeatSource& source, double end);
// A pixel is the mean of two by two, of which none is absent; an odd last column or row is left out.
HeatPanel halvedHeatPanel(const HeatSource& source, double end);

// A picture, and the counts without and with micromaps, side by side on one scale (Waldemarson and Doggett
// 2024, figure 1). All three have one size.
Canvas triptych(const scene::ColourImage& picture, std::string_view method, const HeatSource& without,
                const HeatSource& with);

}  // namespace filigree::jobs
