#include "jobs/canvas.h"

#include "filigree/io/image_file.h"

#include <algorithm>
#include <cmath>

namespace filigree::jobs {
namespace {

uint8_t mixedByte(uint8_t a, uint8_t b, double share) {
    return static_cast<uint8_t>(std::lround(a + share * (b - a)));
}

struct Range {
    uint32_t first;
    uint32_t end;
};

// Pixels of [0, size) that [lo, hi] touches.
Range touched(double lo, double hi, uint32_t size) {
    const auto inside = [&](double v) {
        return static_cast<uint32_t>(std::clamp(v, 0.0, static_cast<double>(size)));
    };
    return {inside(std::floor(lo)), inside(std::ceil(hi))};
}

// How much of pixel `index` an interval covers.
double overlap(uint32_t index, double lo, double hi) {
    return std::max(0.0, std::min(hi, index + 1.0) - std::max(lo, static_cast<double>(index)));
}

// Distance from p to the segment ab.
double distanceTo(Pixel a, Pixel b, Pixel p) {
    const double dx = b.x - a.x;
    const double dy = b.y - a.y;
    const double square = dx * dx + dy * dy;
    const double t = square > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / square, 0.0, 1.0) : 0;
    return std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

// The columns of row `y` within `reach` of the line through ab; all of `columns` for a flat line.
Range nearLine(Pixel a, Pixel b, double y, double reach, Range columns, uint32_t width) {
    const double dy = b.y - a.y;
    const double length = std::hypot(b.x - a.x, dy);
    if (std::abs(dy) < 1e-6 * length || length == 0) return columns;
    const double x = a.x + (y - a.y) / dy * (b.x - a.x);
    const double half = reach * length / std::abs(dy);
    const Range row = touched(x - half - 1, x + half + 1, width);
    return {std::max(row.first, columns.first), std::min(row.end, columns.end)};
}

}  // namespace

Colour mixed(Colour a, Colour b, double share) {
    return {mixedByte(a.r, b.r, share), mixedByte(a.g, b.g, share), mixedByte(a.b, b.b, share)};
}

Canvas::Canvas(uint32_t width, uint32_t height, Colour background)
    : width_(width), height_(height), pixels_(size_t{width} * height, background) {}

void Canvas::blend(uint32_t x, uint32_t y, Colour colour, double share) {
    Colour& pixel = pixels_[size_t{y} * width_ + x];
    pixel = mixed(pixel, colour, share);
}

void Canvas::fillRect(double x, double y, double width, double height, Colour colour) {
    const Range columns = touched(x, x + width, width_);
    const Range rows = touched(y, y + height, height_);
    for (uint32_t row = rows.first; row < rows.end; ++row) {
        const double down = overlap(row, y, y + height);
        for (uint32_t column = columns.first; column < columns.end; ++column) {
            blend(column, row, colour, down * overlap(column, x, x + width));
        }
    }
}

void Canvas::fillDot(Pixel centre, double radius, Colour colour) {
    strokeLine(centre, centre, 2 * radius, colour);
}

void Canvas::strokeLine(Pixel from, Pixel to, double width, Colour colour, double opacity) {
    const double reach = width / 2 + 1;
    const Range columns = touched(std::min(from.x, to.x) - reach, std::max(from.x, to.x) + reach, width_);
    const Range rows = touched(std::min(from.y, to.y) - reach, std::max(from.y, to.y) + reach, height_);
    // A line thinner than a pixel is drawn a pixel wide and fainter.
    const double half = std::max(width, 1.0) / 2;
    const double strength = opacity * std::min(width, 1.0);
    for (uint32_t row = rows.first; row < rows.end; ++row) {
        const Range near = nearLine(from, to, row + 0.5, reach, columns, width_);
        for (uint32_t column = near.first; column < near.end; ++column) {
            const double distance = distanceTo(from, to, {column + 0.5, row + 0.5});
            const double coverage = std::clamp(half + 0.5 - distance, 0.0, 1.0);
            if (coverage > 0) blend(column, row, colour, coverage * strength);
        }
    }
}

Result<std::vector<uint8_t>> Canvas::png() const {
    scene::ColourImage image{width_, height_, {}};
    image.rgba.reserve(pixels_.size() * 4);
    for (const Colour& c : pixels_) image.rgba.insert(image.rgba.end(), {c.r, c.g, c.b, 255});
    return io::encodePng(image);
}

}  // namespace filigree::jobs
