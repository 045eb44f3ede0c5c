// A picture that is drawn in software, with smooth edges.
#pragma once

#include "filigree/core/result.h"
#include "filigree/report/drawing.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace filigree::jobs {

using report::Colour;

// A place on a canvas, in pixels from its top left corner, y downward; pixel (x, y) has its centre half a
// pixel on.
struct Pixel {
    double x = 0;
    double y = 0;
};

// `a` and `b` mixed, `share` in [0, 1] of `b`.
Colour mixed(Colour a, Colour b, double share);

class Canvas {
  public:
    Canvas(uint32_t width, uint32_t height, Colour background);

    [[nodiscard]] uint32_t width() const { return width_; }
    [[nodiscard]] uint32_t height() const { return height_; }
    [[nodiscard]] Colour at(uint32_t x, uint32_t y) const { return pixels_[size_t{y} * width_ + x]; }
    void set(uint32_t x, uint32_t y, Colour colour) { pixels_[size_t{y} * width_ + x] = colour; }

    // Mixes `share` in [0, 1] of `colour` into a pixel.
    void blend(uint32_t x, uint32_t y, Colour colour, double share);

    // Everything below may reach beyond the canvas and is cut there.
    void fillRect(double x, double y, double width, double height, Colour colour);
    void fillDot(Pixel centre, double radius, Colour colour);
    void strokeLine(Pixel from, Pixel to, double width, Colour colour, double opacity = 1);

    // A PNG file of it.
    [[nodiscard]] Result<std::vector<uint8_t>> png() const;

  private:
    uint32_t width_;
    uint32_t height_;
    std::vector<Colour> pixels_;
};

// Calls span(y, first, end) for each row whose pixel centres [first, end) lie in the triangle, cut to width x
// height. Triangles that share an edge leave no gap and no pixel twice between them.
template <class Span>
void forEachSpan(const std::array<Pixel, 3>& triangle, uint32_t width, uint32_t height, Span&& span);

}  // namespace filigree::jobs

#include "jobs/canvas_spans.h"
