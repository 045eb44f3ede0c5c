#include "jobs/overlay.h"

#include "filigree/micromap/curve.h"
#include "filigree/micromap/quadtree.h"

#include "jobs/overlay_legend.h"
#include "jobs/tile_copies.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace filigree::jobs {
namespace {

using micromap::State;

constexpr uint32_t largestSide = 2048;       // pixels
constexpr uint64_t workLimit = 600'000'000;  // pixels written, about two seconds
constexpr uint64_t leafWork = 16;            // what a leaf costs before its pixels
constexpr uint8_t bare = 255;                // label of a pixel without a triangle
constexpr double leastMicroEdge = 4;         // pixels; below it the grid would hide the states
constexpr double fullMicroEdge = 14;

// ---- painting ----

class Painter {
  public:
    Painter(uint32_t width, uint32_t height)
        : width_(width),
          height_(height),
          labels_(size_t{width} * height, bare),
          lines_(size_t{width} * height, 0) {}

    // False once the work limit is reached; the triangle is then not drawn.
    bool draw(const OverlayTriangle& t, const image::AlphaTexture& texture) {
        for (const auto& corners : tileCopies(t.uv, texture.wrapU, texture.wrapV, width_, height_)) {
            if (work_ > workLimit) return false;
            drawCopy(corners, t);
        }
        return true;
    }

    // The states, then the grid, then the outlines over `canvas`, whose top left part is the tile.
    void compose(Canvas& canvas) const {
        for (uint32_t y = 0; y < height_; ++y) {
            for (uint32_t x = 0; x < width_; ++x) {
                const uint8_t label = labels_[size_t{y} * width_ + x];
                if (label == bare) continue;
                canvas.blend(x, y, stateColour(static_cast<State>(label)), 0.72);
                canvas.blend(x, y, overlayInk, lines_[size_t{y} * width_ + x] / 255.0);
            }
        }
        for (const auto& c : outlines_) {
            for (size_t k = 0; k < 3; ++k) canvas.strokeLine(c[k], c[(k + 1) % 3], 1.6, overlayInk, 0.9);
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
        forEachSpan(corners, width_, height_, [&](uint32_t y, uint32_t first, uint32_t end) {
            work_ += end - first;
            for (uint32_t x = first; x < end; ++x) {
                labels_[size_t{y} * width_ + x] = static_cast<uint8_t>(state);
                lines_[size_t{y} * width_ + x] = 0;
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
        const double darkness = 0.15 + 0.35 * visible;
        const auto share = [&](uint32_t k) { return static_cast<double>(k) / n; };
        for (uint32_t k = 1; k < n; ++k) {
            const double a = share(k);
            drawLine(inside(c, a, 0), inside(c, a, 1 - a), darkness);
            drawLine(inside(c, 0, a), inside(c, 1 - a, a), darkness);
            drawLine(inside(c, a, 0), inside(c, 0, a), darkness);
        }
    }

    // A line one pixel wide: at each step along its longer axis, two pixels share its darkness (Wu 1991).
    void drawLine(Pixel from, Pixel to, double darkness) {
        const bool steep = std::abs(to.y - from.y) > std::abs(to.x - from.x);
        const auto along = [&](Pixel p) { return steep ? p.y : p.x; };
        const auto across = [&](Pixel p) { return steep ? p.x : p.y; };
        if (along(from) > along(to)) std::swap(from, to);
        const double length = along(to) - along(from);
        if (length <= 0) return;
        const double slope = (across(to) - across(from)) / length;
        const uint32_t end = firstCentre(along(to), steep ? height_ : width_);
        for (uint32_t step = firstCentre(along(from), end); step < end; ++step) {
            const double place = across(from) + slope * (step + 0.5 - along(from)) - 0.5;
            const double whole = std::floor(place);
            darken(step, whole, (1 - place + whole) * darkness, steep);
            darken(step, whole + 1, (place - whole) * darkness, steep);
        }
        work_ += end;
    }

    void darken(uint32_t along, double across, double share, bool steep) {
        if (across < 0 || across >= (steep ? width_ : height_)) return;
        const auto other = static_cast<uint32_t>(across);
        uint8_t& line = lines_[steep ? size_t{along} * width_ + other : size_t{other} * width_ + along];
        line = std::max(line, static_cast<uint8_t>(255 * share));
    }

    uint32_t width_;
    uint32_t height_;
    std::vector<uint8_t> labels_;  // a State, or bare
    std::vector<uint8_t> lines_;   // how dark the grid is
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
    const uint32_t wanted = side > largestSide / 8 ? largestSide : largestSide / 2;
    const uint32_t scale = std::max(1U, wanted / side);
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

// Wide enough for the longest entry, however narrow the tile.
uint32_t canvasWidth(Size tile) {
    return std::max(tile.width, 512U);
}

}  // namespace

Overlay drawOverlay(const image::AlphaTexture& texture, double factor,
                    const std::vector<OverlayTriangle>& triangles, const OverlayLegend& legend) {
    const image::AlphaTexture shown = reduced(texture);
    const Size tile = tileSize(shown.image);
    const uint32_t width = canvasWidth(tile);
    const LegendStrip strip(legend, width);
    Overlay overlay{Canvas(width, tile.height + strip.height(), {255, 255, 255}), 0};
    drawAlpha(overlay.canvas, shown, tile, factor);
    Painter painter(tile.width, tile.height);
    for (const OverlayTriangle& t : triangles) {
        if (!painter.draw(t, texture)) break;
        ++overlay.drawn;
    }
    painter.compose(overlay.canvas);
    strip.draw(overlay.canvas, tile.height);
    return overlay;
}

}  // namespace filigree::jobs
