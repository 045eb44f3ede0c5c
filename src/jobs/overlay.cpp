#include "jobs/overlay.h"

#include "filigree/micromap/curve.h"
#include "filigree/micromap/quadtree.h"
#include "filigree/report/number.h"

#include "jobs/lettering.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace filigree::jobs {
namespace {

using micromap::State;

constexpr uint32_t largestSide = 2048;       // pixels
constexpr uint64_t workLimit = 600'000'000;  // pixels written, about two seconds
constexpr uint64_t leafWork = 16;            // what a leaf costs before its pixels
constexpr int mostCopies = 64;               // of one triangle, along one axis
constexpr uint8_t bare = 255;                // label of a pixel without a triangle
constexpr double leastMicroEdge = 4;         // pixels; below it the grid would hide the states
constexpr double fullMicroEdge = 14;
constexpr Colour ink{20, 24, 28};

// ---- wrapping ----

// How one copy of a triangle comes into the tile along one axis: at + sign * (coordinate - at).
struct AxisCopy {
    double offset = 0;
    double sign = 1;
    [[nodiscard]] double operator()(double coordinate) const { return offset + sign * coordinate; }
};

std::vector<AxisCopy> copiesAlong(double lo, double hi, image::Wrap wrap) {
    if (wrap == image::Wrap::clampToEdge) return {{0, 1}};
    std::vector<AxisCopy> copies;
    const double first = std::floor(lo);
    const double last = std::max(first, std::ceil(hi) - 1);
    for (double tile = first; tile <= last && copies.size() < mostCopies; ++tile) {
        const bool odd = std::fmod(std::abs(tile), 2) == 1;
        if (odd && wrap == image::Wrap::mirroredRepeat) {
            copies.push_back({tile + 1, -1});
        } else {
            copies.push_back({-tile, 1});
        }
    }
    return copies;
}

bool isDrawable(const OverlayTriangle& t) {
    // Beyond 2^20 tiles single precision leaves nothing to see within one.
    return std::all_of(t.uv.begin(), t.uv.end(), [](const mesh::Uv& uv) {
        return std::abs(uv.u) < 0x1p20F && std::abs(uv.v) < 0x1p20F;
    });
}

// ---- painting ----

class Painter {
  public:
    Painter(uint32_t width, uint32_t height)
        : labels_(size_t{width} * height, bare), lines_(width, height, {0, 0, 0}) {}

    // False once the work limit is reached; the triangle is then not drawn.
    bool draw(const OverlayTriangle& t, const image::AlphaTexture& texture) {
        if (!isDrawable(t)) return true;
        const auto [u0, u1] = std::minmax({t.uv[0].u, t.uv[1].u, t.uv[2].u});
        const auto [v0, v1] = std::minmax({t.uv[0].v, t.uv[1].v, t.uv[2].v});
        for (const AxisCopy& cu : copiesAlong(u0, u1, texture.wrapU)) {
            for (const AxisCopy& cv : copiesAlong(v0, v1, texture.wrapV)) {
                if (work_ > workLimit) return false;
                std::array<Pixel, 3> corners{};
                for (size_t k = 0; k < 3; ++k) {
                    corners[k] = {cu(t.uv[k].u) * lines_.width(), cv(t.uv[k].v) * lines_.height()};
                }
                drawCopy(corners, t);
            }
        }
        return true;
    }

    // The states, then the grid, then the outlines over `canvas`, whose top left part is the tile.
    void compose(Canvas& canvas) const {
        for (uint32_t y = 0; y < lines_.height(); ++y) {
            for (uint32_t x = 0; x < lines_.width(); ++x) {
                const uint8_t label = labels_[size_t{y} * lines_.width() + x];
                if (label == bare) continue;
                canvas.blend(x, y, stateColour(static_cast<State>(label)), 0.72);
                canvas.blend(x, y, ink, lines_.at(x, y).r / 255.0);
            }
        }
        for (const auto& c : outlines_) {
            for (size_t k = 0; k < 3; ++k) canvas.strokeLine(c[k], c[(k + 1) % 3], 1.6, ink, 0.9);
        }
    }

  private:
    void drawCopy(const std::array<Pixel, 3>& corners, const OverlayTriangle& t) {
        if (t.index < 0) {
            fill(corners, micromap::stateOfSpecialIndex(t.index));
        } else {
            drawRecord(corners, *t.set, t.set->records[static_cast<size_t>(t.index)]);
        }
        outlines_.push_back(corners);
    }

    void drawRecord(const std::array<Pixel, 3>& corners, const micromap::FlatSet& set,
                    const micromap::Record& r) {
        const auto flat = std::span(set.data).subspan(r.byteOffset, micromap::flatBytes(r.level, r.format));
        const auto tree = micromap::quadtreeFromFlat(flat, r.level, r.format);
        micromap::forEachLeaf(tree.view(), [&](uint64_t first, unsigned depth, State state) {
            fill(leafCorners(corners, first >> (2 * (r.level - depth)), depth), state);
        });
        drawGrid(corners, 1U << r.level);
    }

    static std::array<Pixel, 3> leafCorners(const std::array<Pixel, 3>& c, uint64_t index, unsigned depth) {
        std::array<Pixel, 3> out{};
        const auto places = micromap::corners(micromap::latticeTriangle(static_cast<uint32_t>(index), depth));
        const double n = 1U << depth;
        for (size_t k = 0; k < 3; ++k) out[k] = inside(c, places[k].i / n, places[k].j / n);
        return out;
    }

    static Pixel inside(const std::array<Pixel, 3>& c, double b1, double b2) {
        return {c[0].x + b1 * (c[1].x - c[0].x) + b2 * (c[2].x - c[0].x),
                c[0].y + b1 * (c[1].y - c[0].y) + b2 * (c[2].y - c[0].y)};
    }

    void fill(const std::array<Pixel, 3>& corners, State state) {
        work_ += leafWork;
        forEachSpan(corners, lines_.width(), lines_.height(), [&](uint32_t y, uint32_t first, uint32_t end) {
            work_ += end - first;
            for (uint32_t x = first; x < end; ++x) {
                labels_[size_t{y} * lines_.width() + x] = static_cast<uint8_t>(state);
                lines_.set(x, y, {0, 0, 0});
            }
        });
    }

    // The edges between n x n micro-triangles, fainter the closer they stand.
    void drawGrid(const std::array<Pixel, 3>& c, uint32_t n) {
        double edge = INFINITY;
        for (size_t k = 0; k < 3; ++k) {
            edge = std::min(edge, std::hypot(c[k].x - c[(k + 1) % 3].x, c[k].y - c[(k + 1) % 3].y) / n);
        }
        const double visible =
            std::clamp((edge - leastMicroEdge) / (fullMicroEdge - leastMicroEdge), 0.0, 1.0);
        if (visible == 0) return;
        const auto share = [&](uint32_t k) { return static_cast<double>(k) / n; };
        for (uint32_t k = 1; k < n; ++k) {
            const double a = share(k);
            drawLine(inside(c, a, 0), inside(c, a, 1 - a), visible);
            drawLine(inside(c, 0, a), inside(c, 1 - a, a), visible);
            drawLine(inside(c, a, 0), inside(c, 0, a), visible);
        }
    }

    void drawLine(Pixel from, Pixel to, double visible) {
        work_ += static_cast<uint64_t>(std::min(1e6, 8 * std::hypot(to.x - from.x, to.y - from.y)));
        lines_.strokeLine(from, to, 1, {255, 255, 255}, 0.15 + 0.35 * visible);
    }

    std::vector<uint8_t> labels_;  // a State, or bare
    Canvas lines_;                 // of the grid: 255 where they are dark
    std::vector<std::array<Pixel, 3>> outlines_;
    uint64_t work_ = 0;
};

// ---- the alpha below, the legend under it ----

struct Size {
    uint32_t width;
    uint32_t height;
};

// Whole pixels a texel where the texture is small, a coarser level where it is large.
Size tileSize(const image::AlphaImage& image) {
    const uint32_t side = std::max(image.width, image.height);
    const uint32_t scale = std::max(1U, largestSide / side);
    return {image.width * scale, image.height * scale};
}

image::AlphaTexture reduced(const image::AlphaTexture& texture) {
    image::AlphaTexture small = texture;
    while (std::max(small.image.width, small.image.height) > largestSide)
        small.image = image::halve(small.image);
    return small;
}

void drawAlpha(Canvas& canvas, const image::AlphaTexture& texture, Size tile, double factor) {
    const double sx = static_cast<double>(texture.image.width) / tile.width;
    const double sy = static_cast<double>(texture.image.height) / tile.height;
    const bool nearest = texture.filter == image::Filter::nearest;
    for (uint32_t y = 0; y < tile.height; ++y) {
        for (uint32_t x = 0; x < tile.width; ++x) {
            const double px = (x + 0.5) * sx;
            const double py = (y + 0.5) * sy;
            const double alpha = nearest ? sampleNearest(texture, px, py) : sampleBilinear(texture, px, py);
            const auto grey =
                static_cast<uint8_t>(std::lround(40 + 215 * std::clamp(alpha * factor, 0.0, 1.0)));
            canvas.set(x, y, {grey, grey, grey});
        }
    }
}

constexpr double textSize = 24;
constexpr double rowHeight = 40;
constexpr double margin = 20;

struct LegendItem {
    std::string text;
    State state;
    Pixel at;
};

// States in rows of at most `width` pixels, below the title.
std::vector<LegendItem> layOutLegend(const OverlayLegend& legend, double width) {
    std::vector<LegendItem> items;
    Pixel at{margin, rowHeight + margin};
    for (size_t s = 0; s < 4; ++s) {
        const auto state = static_cast<State>(s);
        const std::string text = std::string(stateName(state)) + " " + report::formatShare(legend.shares[s]);
        const double needed = 36 + letteringWidth(text, textSize) + 2 * margin;
        if (at.x > margin && at.x + needed > width) at = {margin, at.y + rowHeight};
        items.push_back({text, state, at});
        at.x += needed;
    }
    return items;
}

void drawLegend(Canvas& canvas, double top, const OverlayLegend& legend,
                const std::vector<LegendItem>& items) {
    canvas.fillRect(0, top, canvas.width(), canvas.height() - top, {255, 255, 255});
    drawText(canvas, legend.title, {margin, top + margin + 18}, textSize, report::Anchor::start, ink, true);
    for (const LegendItem& item : items) {
        const double y = top + item.at.y;
        canvas.fillRect(item.at.x, y + 2, 24, 24, ink);
        canvas.fillRect(item.at.x + 1, y + 3, 22, 22, stateColour(item.state));
        drawText(canvas, item.text, {item.at.x + 34, y + 22}, textSize, report::Anchor::start, ink);
    }
}

// Wide enough for the longest entry, however narrow the tile.
uint32_t canvasWidth(Size tile) {
    return std::max(tile.width, 512U);
}

}  // namespace

// From Okabe and Ito, "Color universal design" (2008).
Colour stateColour(State state) {
    constexpr std::array<Colour, 4> colours = {{{0, 90, 170}, {110, 200, 245}, {205, 70, 0}, {250, 190, 40}}};
    return colours[static_cast<size_t>(state)];
}

const char* stateName(State state) {
    constexpr std::array<const char*, 4> names = {"transparent", "opaque", "unknown-transparent",
                                                  "unknown-opaque"};
    return names[static_cast<size_t>(state)];
}

Overlay drawOverlay(const image::AlphaTexture& texture, double factor,
                    const std::vector<OverlayTriangle>& triangles, const OverlayLegend& legend) {
    const image::AlphaTexture shown = reduced(texture);
    const Size tile = tileSize(shown.image);
    const uint32_t width = canvasWidth(tile);
    const auto items = layOutLegend(legend, width);
    const double below = items.back().at.y + rowHeight + margin / 2;
    Overlay overlay{Canvas(width, tile.height + static_cast<uint32_t>(below), {255, 255, 255}), 0};
    drawAlpha(overlay.canvas, shown, tile, factor);
    Painter painter(tile.width, tile.height);
    for (const OverlayTriangle& t : triangles) {
        if (!painter.draw(t, texture)) break;
        ++overlay.drawn;
    }
    painter.compose(overlay.canvas);
    drawLegend(overlay.canvas, tile.height, legend, items);
    return overlay;
}

}  // namespace filigree::jobs
