// Flat drawings of a few shapes: what charts are laid out as, before they become SVG or pixels.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace filigree::report {

// sRGB, 8 bits a channel.
struct Colour {
    uint8_t r = 0;
    uint8_t g = 0;
    uint8_t b = 0;
    bool operator==(const Colour&) const = default;
};

// Inks follow the reader's light or dark theme; shapes that carry data have a Colour of their own instead.
enum class Ink : uint8_t { text, faint, grid };

// All lengths are drawing units, y downward; one unit is one CSS pixel at natural size.
struct Rect {
    double x = 0, y = 0, width = 0, height = 0;
    Colour fill;
    std::string hint{};  // shown on hover; empty for none
    bool outlined = true;
};
struct Line {
    double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    Ink ink = Ink::text;
    double width = 1;
};
struct Polyline {
    std::vector<std::pair<double, double>> points;
    Colour colour;
    double width = 2;
    bool dashed = false;
};
struct Dot {
    double x = 0, y = 0, radius = 3;
    Colour fill;
    std::string hint{};
    bool hollow = false;  // a ring
};
enum class Anchor : uint8_t { start, middle, end };
struct Text {
    double x = 0, y = 0;  // of the baseline, at the anchor
    std::string text;
    double size = 12;  // em
    Anchor anchor = Anchor::start;
    Ink ink = Ink::text;
    bool bold = false;
    bool upward = false;  // turned to read from bottom to top
};
using Shape = std::variant<Rect, Line, Polyline, Dot, Text>;

struct Drawing {
    double width = 0;
    double height = 0;
    std::string title;          // for readers that cannot see it
    std::vector<Shape> shapes;  // in painting order
};

// About how wide a text is set in a sans-serif of `size`.
double textWidth(const std::string& text, double size);

// An SVG document that stands alone or inline in HTML, scales with its container and follows the reader's
// light or dark theme.
std::string toSvg(const Drawing& drawing);

}  // namespace filigree::report
