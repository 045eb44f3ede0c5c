#include "jobs/vq_picture.h"

#include "filigree/quadmap/place.h"

#include "jobs/lettering.h"
#include "jobs/overlay_legend.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

using quadmap::Region;
using quadmap::Square;

constexpr uint32_t panel = 192;  // pixels a side, a multiple of 32
constexpr uint32_t gap = 12;
constexpr uint32_t caption = 22;
constexpr double textSize = 13;
constexpr Colour ground{236, 236, 236};
constexpr Colour lost{255, 225, 25};  // known in the source, mixed in the map
constexpr Colour freeColour{255, 255, 255};

Colour colourOf(Region region) {
    switch (region) {
        case Region::transparent:
            return stateColour(micromap::State::transparent);
        case Region::opaque:
            return stateColour(micromap::State::opaque);
        case Region::mixed:
            return stateColour(micromap::State::unknownTransparent);
        case Region::free:
            break;
    }
    return freeColour;
}

// The texture's alpha at a point of the square, in texel space.
double alphaAt(const VqInput& input, double x, double y) {
    const image::AlphaImage& image = input.texture.image;
    if (input.pairs.empty()) {
        const quadmap::Crop& c = input.crop;
        return image::sampleBilinear(input.texture, c.x0 + x * (c.x1 - c.x0), c.y0 + y * (c.y1 - c.y0));
    }
    const bool isFirst = x + y <= 1;
    const SquarePair& pair = input.pairs.front();
    if (!isFirst && !pair.second) return 0;
    const quadmap::HalfTriangle& t = isFirst ? pair.first : *pair.second;
    const double i = isFirst ? x : 1 - x;
    const double j = isFirst ? y : 1 - y;
    const auto mix = [&](double a, double b, double c) { return a + i * (b - a) + j * (c - a); };
    const double u = mix(t.uv[0].u, t.uv[1].u, t.uv[2].u) * image.width;
    const double v = mix(t.uv[0].v, t.uv[1].v, t.uv[2].v) * image.height;
    const bool isNear = std::fabs(u) < 1e9 && std::fabs(v) < 1e9;  // false for NaN
    return isNear ? image::sampleBilinear(input.texture, u, v) : 0;
}

class Sheet {
  public:
    Sheet() : canvas_(5 * panel + 6 * gap, 2 * (panel + gap + caption) + gap, ground) {}

    void alpha(const VqInput& input, unsigned column, unsigned row) {
        const auto [left, top] = corner(column, row);
        for (uint32_t y = 0; y < panel; ++y) {
            for (uint32_t x = 0; x < panel; ++x) {
                const double alpha = alphaAt(input, (x + 0.5) / panel, (y + 0.5) / panel);
                const auto grey = static_cast<uint8_t>(std::lround(255 * std::clamp(alpha, 0.0, 1.0)));
                canvas_.set(left + x, top + y, {grey, grey, grey});
            }
        }
        label(column, row, "alpha");
    }

    void square(const Square& source, const Square& map, unsigned column, unsigned row,
                const std::string& name) {
        const auto [left, top] = corner(column, row);
        const double size = double(panel) / map.side;
        for (unsigned y = 0; y < map.side; ++y) {
            for (unsigned x = 0; x < map.side; ++x) {
                const bool isLost = quadmap::isKnown(source.at(x, y)) && !quadmap::isKnown(map.at(x, y));
                canvas_.fillRect(left + x * size, top + y * size, size, size,
                                 isLost ? lost : colourOf(map.at(x, y)));
            }
        }
        label(column, row, name);
    }

    Canvas take() { return std::move(canvas_); }

  private:
    static std::pair<uint32_t, uint32_t> corner(unsigned column, unsigned row) {
        return {gap + column * (panel + gap), gap + row * (panel + gap + caption)};
    }
    void label(unsigned column, unsigned row, const std::string& text) {
        const auto [left, top] = corner(column, row);
        drawText(canvas_, text, {double(left), double(top + panel) + textSize + 3}, textSize,
                 report::Anchor::start, overlayInk);
    }

    Canvas canvas_;
};

void drawRow(const VqInput& input, const VqMap& map, const Square& source, unsigned row,
             std::span<const VqMeasure> shown, Sheet& sheet) {
    sheet.alpha(input, 0, row);
    sheet.square(source, source, 1, row,
                 fmt::format("source {}x{}: {:.1f} % known", source.side, source.side,
                             100 * quadmap::savings(source)));
    unsigned column = 2;
    for (const VqMeasure measure : shown) {
        const auto& result = map.results[indexOf(measure)];
        if (!result) continue;
        sheet.square(source, result->square, column++, row,
                     fmt::format("{}: {} lost", nameOf(measure), map.totals.substitutions[indexOf(measure)]));
    }
}

}  // namespace

Canvas drawMap(const VqInput& input, const VqMap& map) {
    static constexpr std::array row16{VqMeasure::vq2Sensible, VqMeasure::vq2Best, VqMeasure::vq2Plus};
    static constexpr std::array row32{VqMeasure::vq4Paper, VqMeasure::vq4Best, VqMeasure::vq4Plus};
    Sheet sheet;
    drawRow(input, map, map.source16, 0, row16, sheet);
    drawRow(input, map, map.source32, 1, row32, sheet);
    return sheet.take();
}

}  // namespace filigree::jobs
