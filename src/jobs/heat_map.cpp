#include "jobs/heat_map.h"

#include "filigree/report/number.h"

#include "jobs/colour_ramp.h"
#include "jobs/lettering.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

constexpr Colour blank{255, 255, 255};
constexpr Colour heatInk{20, 24, 28};
constexpr uint32_t leastPanel = 360;  // pixels; below it a heat map's pixels are magnified

// The sums that count.
std::vector<uint32_t> present(const HeatSource& source) {
    std::vector<uint32_t> sums;
    std::ranges::copy_if(source.sums, std::back_inserter(sums),
                         [](uint32_t sum) { return sum != HeatSource::absent; });
    return sums;
}

// Draws one value a pixel, `zoom` times as large.
template <class ColourAt>
void drawPanel(Canvas& canvas, uint32_t left, uint32_t top, const HeatSource& size, uint32_t zoom,
               ColourAt&& colourAt) {
    for (uint32_t y = 0; y < size.height * zoom; ++y) {
        for (uint32_t x = 0; x < size.width * zoom; ++x)
            canvas.set(left + x, top + y, colourAt(size_t{y / zoom} * size.width + x / zoom));
    }
}

void drawHeat(Canvas& canvas, uint32_t left, uint32_t top, const HeatSource& source, uint32_t zoom,
              double end) {
    const report::ColourScale ramp{"", heatRamp(), {}};
    drawPanel(canvas, left, top, source, zoom, [&](size_t pixel) {
        if (source.sums[pixel] == HeatSource::absent) return blank;
        return report::colourAt(ramp, rampPlace(source.at(pixel), end));
    });
}

// The bar with its numbers, laid out in shares of the text's size.
struct Legend {
    double size = 14;  // pixels, em

    [[nodiscard]] uint32_t height() const { return static_cast<uint32_t>(std::ceil(4.6 * size)); }

    void draw(Canvas& canvas, double left, double top, double width, const report::ColourScale& scale) const {
        const double margin = std::ceil(size);
        drawText(canvas, scale.title, {left + margin, top + 1.5 * size}, size, report::Anchor::start, heatInk,
                 true);
        const double bar = std::floor(std::min(width - 2 * margin, 30 * size));
        for (double x = 0; x < bar; ++x)
            canvas.fillRect(left + margin + x, top + 2 * size, 1, size, report::colourAt(scale, x / bar));
        for (const auto& mark : scale.marks) {
            const auto anchor = mark.at <= 0   ? report::Anchor::start
                                : mark.at >= 1 ? report::Anchor::end
                                               : report::Anchor::middle;
            drawText(canvas, mark.text, {left + margin + bar * mark.at, top + 4.1 * size}, size, anchor,
                     heatInk);
        }
    }
};

double textSize(uint32_t width) {
    return std::clamp(width / 45.0, 13.0, 28.0);
}

std::string meanAndMaximum(const HeatSource& source) {
    return fmt::format("mean {}, maximum {}", report::formatCompact(source.mean()),
                       report::formatCompact(source.maximum()));
}

std::string withoutCaption(const HeatSource& without) {
    return fmt::format("texture: {}", meanAndMaximum(without));
}

std::string withCaption(std::string_view method, const HeatSource& without, const HeatSource& with) {
    std::string text = fmt::format("{}: {}", method, meanAndMaximum(with));
    if (without.mean() > 0)
        text += fmt::format(", {} fewer", report::formatShare(1 - with.mean() / without.mean()));
    return text;
}

}  // namespace

double HeatSource::mean() const {
    const auto counts = present(*this);
    const double sum = std::accumulate(counts.begin(), counts.end(), 0.0);
    return counts.empty() ? 0 : sum / static_cast<double>(counts.size()) / samples;
}

double HeatSource::maximum() const {
    const auto counts = present(*this);
    return counts.empty() ? 0 : static_cast<double>(*std::ranges::max_element(counts)) / samples;
}

double heatEnd(const HeatSource& source) {
    std::vector<uint32_t> sums = present(source);
    const auto at = sums.begin() + static_cast<std::ptrdiff_t>((sums.size() - 1) * 999 / 1000);
    std::nth_element(sums.begin(), at, sums.end());
    const double most = *at > 0 ? static_cast<double>(*at) / source.samples : source.maximum();
    return rampEnd(most);
}

Canvas heatMap(const HeatSource& source) {
    const uint32_t zoom = std::max(1u, (leastPanel + source.width - 1) / source.width);
    const uint32_t width = source.width * zoom;
    const uint32_t height = source.height * zoom;
    const Legend legend{textSize(width)};
    Canvas canvas(width, height + legend.height(), blank);
    const double end = heatEnd(source);
    drawHeat(canvas, 0, 0, source, zoom, end);
    const std::string title = fmt::format("{}: {}", source.what, meanAndMaximum(source));
    legend.draw(canvas, 0, height, width, rampScale(heatRamp(), title, end, ""));
    return canvas;
}

HeatPanel heatPanel(const HeatSource& source, double end) {
    HeatPanel panel{Canvas(source.width, source.height, blank),
                    rampScale(heatRamp(), std::string(source.what), end, meanAndMaximum(source))};
    drawHeat(panel.picture, 0, 0, source, 1, end);
    return panel;
}

HeatPanel halvedHeatPanel(const HeatSource& source, double end) {
    const uint32_t width = source.width / 2;
    const uint32_t height = source.height / 2;
    if (width == 0 || height == 0) return heatPanel(source, end);
    std::vector<uint32_t> sums(size_t{width} * height);
    for (uint32_t y = 0; y < 2 * height; ++y) {
        for (uint32_t x = 0; x < 2 * width; ++x)
            sums[size_t{y / 2} * width + x / 2] += source.sums[size_t{y} * source.width + x];
    }
    HeatPanel panel = heatPanel({source.what, sums, width, height, 4 * source.samples}, end);
    panel.scale.note = meanAndMaximum(source);
    return panel;
}

Canvas triptych(const scene::ColourImage& picture, std::string_view method, const HeatSource& without,
                const HeatSource& with) {
    const uint32_t zoom = std::max(1u, (leastPanel + picture.width - 1) / picture.width);
    const uint32_t width = picture.width * zoom;
    const uint32_t height = picture.height * zoom;
    const uint32_t gap = std::max(4u, width / 120);
    const double size = textSize(width);
    const Legend legend{size};
    const auto captions = static_cast<uint32_t>(std::ceil(2.1 * size));
    Canvas canvas(3 * width + 2 * gap, captions + height + legend.height(), blank);
    const double end = heatEnd(without);
    const auto left = [&](uint32_t panel) { return panel * (width + gap); };
    const auto caption = [&](uint32_t panel, const std::string& text) {
        drawText(canvas, text, {left(panel) + 0.3 * size, 1.4 * size}, size, report::Anchor::start, heatInk,
                 true);
    };
    caption(0, fmt::format("picture, {} x {}", picture.width, picture.height));
    caption(1, withoutCaption(without));
    caption(2, withCaption(method, without, with));
    drawPanel(canvas, left(0), captions, without, zoom, [&](size_t pixel) {
        const uint8_t* rgba = &picture.rgba[4 * pixel];
        return Colour{rgba[0], rgba[1], rgba[2]};
    });
    drawHeat(canvas, left(1), captions, without, zoom, end);
    drawHeat(canvas, left(2), captions, with, zoom, end);
    legend.draw(canvas, left(1), captions + height, width,
                rampScale(heatRamp(), std::string(without.what), end, ""));
    return canvas;
}

}  // namespace filigree::jobs
