#include "jobs/vq_picture.h"

#include "filigree/quadmap/place.h"
#include "filigree/quadmap/transform.h"

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

constexpr uint32_t alphaSide = 96;  // pixels
constexpr uint32_t panel = 192;     // pixels a side on a sheet, a multiple of 32 and of alphaSide
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

VqPanel alphaPanel(const VqInput& input) {
    VqPanel out{Canvas(alphaSide, alphaSide, freeColour), "alpha", false};
    for (uint32_t y = 0; y < alphaSide; ++y) {
        for (uint32_t x = 0; x < alphaSide; ++x) {
            const double alpha = alphaAt(input, (x + 0.5) / alphaSide, (y + 0.5) / alphaSide);
            const auto grey = static_cast<uint8_t>(std::lround(255 * std::clamp(alpha, 0.0, 1.0)));
            out.picture.set(x, y, {grey, grey, grey});
        }
    }
    return out;
}

// A pixel a region.
VqPanel squarePanel(const Square& source, const Square& map, const std::string& text) {
    VqPanel out{Canvas(map.side, map.side, freeColour), text, true};
    for (unsigned y = 0; y < map.side; ++y) {
        for (unsigned x = 0; x < map.side; ++x) {
            const bool isLost = quadmap::isKnown(source.at(x, y)) && !quadmap::isKnown(map.at(x, y));
            out.picture.set(x, y, isLost ? lost : colourOf(map.at(x, y)));
        }
    }
    return out;
}

// As an encoder's words see it: each vector, of 8 x 8, the way its quadrant's transform stores it.
Square storedWay(const Square& source, unsigned transforms) {
    const unsigned vector = source.side / 8;
    Square stored(source.side);
    for (unsigned y = 0; y < source.side; ++y) {
        for (unsigned x = 0; x < source.side; ++x) {
            const unsigned quadrant = 2 * y / source.side * 2 + 2 * x / source.side;
            const auto transform =
                static_cast<quadmap::Transform>(quadrant == 0 ? 0 : transforms >> 3 * (quadrant - 1) & 7);
            const quadmap::Cell cell = quadmap::storedCell(transform, vector, {x % vector, y % vector});
            stored.at(x - x % vector + cell.x, y - y % vector + cell.y) = source.at(x, y);
        }
    }
    return stored;
}

std::vector<VqPanel> panelRow(const VqMap& map, const Square& source, std::span<const VqMeasure> shown) {
    std::vector<VqPanel> row;
    row.push_back(squarePanel(source, source,
                              fmt::format("source {}x{}: {:.1f} % known", source.side, source.side,
                                          100 * quadmap::savings(source))));
    const VqMeasure best = source.side == 16 ? VqMeasure::vq2Best : VqMeasure::vq4Best;
    if (const auto& result = map.results[indexOf(best)]) {
        const Square stored = storedWay(source, result->transforms);
        row.push_back(squarePanel(stored, stored, fmt::format("turned for {}", nameOf(best))));
    }
    for (const VqMeasure measure : shown) {
        const auto& result = map.results[indexOf(measure)];
        if (!result) continue;
        row.push_back(squarePanel(
            source, result->square,
            fmt::format("{}: {} lost", nameOf(measure), map.totals.substitutions[indexOf(measure)])));
    }
    return row;
}

// Enlarged by whole pixels, with its caption below.
void place(const VqPanel& from, unsigned column, unsigned row, Canvas& sheet) {
    const uint32_t left = gap + column * (panel + gap);
    const uint32_t top = gap + row * (panel + gap + caption);
    const uint32_t times = panel / from.picture.width();
    for (uint32_t y = 0; y < panel; ++y) {
        for (uint32_t x = 0; x < panel; ++x)
            sheet.set(left + x, top + y, from.picture.at(x / times, y / times));
    }
    drawText(sheet, from.caption, {double(left), double(top + panel) + textSize + 3}, textSize,
             report::Anchor::start, overlayInk);
}

}  // namespace

VqPanels drawPanels(const VqInput& input, const VqMap& map) {
    static constexpr std::array row16{VqMeasure::vq2Sensible, VqMeasure::vq2Best, VqMeasure::vq2Plus};
    static constexpr std::array row32{VqMeasure::vq4Paper, VqMeasure::vq4Best, VqMeasure::vq4Plus};
    return {alphaPanel(input), {panelRow(map, map.source16, row16), panelRow(map, map.source32, row32)}};
}

Canvas drawSheet(const VqPanels& panels) {
    Canvas sheet(6 * panel + 7 * gap, 2 * (panel + gap + caption) + gap, ground);
    for (unsigned row = 0; row < panels.rows.size(); ++row) {
        place(panels.alpha, 0, row, sheet);
        for (unsigned k = 0; k < panels.rows[row].size(); ++k) place(panels.rows[row][k], k + 1, row, sheet);
    }
    return sheet;
}

report::Legend panelLegend() {
    return {{{colourOf(Region::transparent), "transparent"},
             {colourOf(Region::opaque), "opaque"},
             {colourOf(Region::mixed), "mixed in the source"},
             {lost, "known in the source, given up by the encoder"},
             {freeColour, "beyond the triangles"}}};
}

}  // namespace filigree::jobs
