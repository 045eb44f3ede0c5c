#include "jobs/lettering.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

namespace filigree::jobs {
namespace {

// The face: a dot matrix of '!' to '~', rows from the capitals' top to the descenders' foot. Dots that touch
// are joined by strokes, which makes it smooth at any size.
constexpr std::array<std::string_view, 94> face = {
    // clang-format off
    "#/#/#/#/#/./#",
    "#.#/#.#/#.#",
    ".#.#./.#.#./#####/.#.#./#####/.#.#./.#.#.",
    "..#../.####/#.#../.###./..#.#/####./..#..",
    ".#...#/#.#.#./.#..#./..#.../.#..#./.#.#.#/#...#.",
    ".##../#..#./#.#../.#.../#.#.#/#..#./.##.#",
    "#/#/#",
    "..#/.#./#../#../#../.#./..#",
    "#../.#./..#/..#/..#/.#./#..",
    "...../..#../#.#.#/.###./#.#.#/..#..",
    "...../..#../..#../#####/..#../..#..",
    "../../../../../.#/.#/#.",
    "..../..../..../####",
    "././././././#",
    "....#/...#./...#./..#../.#.../.#.../#....",
    ".##./#..#/#..#/#..#/#..#/#..#/.##.",
    "..#../.##../..#../..#../..#../..#../.###.",
    ".###./#...#/....#/...#./..#../.#.../#####",
    ".###./#...#/....#/..##./....#/#...#/.###.",
    "...#./..##./.#.#./#..#./#####/...#./...#.",
    "#####/#..../####./....#/....#/#...#/.###.",
    "..##./.#.../#..../####./#...#/#...#/.###.",
    "#####/....#/...#./...#./..#../..#../..#..",
    ".###./#...#/#...#/.###./#...#/#...#/.###.",
    ".###./#...#/#...#/.####/....#/...#./.##..",
    "././#/././#",
    "../../.#/../../.#/.#/#.",
    "..../...#/..#./.#../..#./...#",
    "..../..../####/..../####",
    "..../#.../.#../..#./.#../#...",
    ".###./#...#/....#/...#./..#../...../..#..",
    ".###./#...#/#.###/#.#.#/#.##./#..../.###.",
    "..#../.#.#./#...#/#...#/#####/#...#/#...#",
    "####./#...#/#...#/####./#...#/#...#/####.",
    ".###./#...#/#..../#..../#..../#...#/.###.",
    "####./#...#/#...#/#...#/#...#/#...#/####.",
    "#####/#..../#..../####./#..../#..../#####",
    "#####/#..../#..../####./#..../#..../#....",
    ".###./#...#/#..../#.###/#...#/#...#/.###.",
    "#...#/#...#/#...#/#####/#...#/#...#/#...#",
    "###/.#./.#./.#./.#./.#./###",
    "..##/...#/...#/...#/...#/#..#/.##.",
    "#...#/#..#./#.#../##.../#.#../#..#./#...#",
    "#.../#.../#.../#.../#.../#.../####",
    "#...#/##.##/#.#.#/#.#.#/#...#/#...#/#...#",
    "#...#/##..#/##..#/#.#.#/#..##/#..##/#...#",
    ".###./#...#/#...#/#...#/#...#/#...#/.###.",
    "####./#...#/#...#/####./#..../#..../#....",
    ".###./#...#/#...#/#...#/#.#.#/#..#./.##.#",
    "####./#...#/#...#/####./#.#../#..#./#...#",
    ".###./#...#/#..../.###./....#/#...#/.###.",
    "#####/..#../..#../..#../..#../..#../..#..",
    "#...#/#...#/#...#/#...#/#...#/#...#/.###.",
    "#...#/#...#/#...#/#...#/.#.#./.#.#./..#..",
    "#...#/#...#/#...#/#.#.#/#.#.#/##.##/#...#",
    "#...#/#...#/.#.#./..#../.#.#./#...#/#...#",
    "#...#/#...#/.#.#./..#../..#../..#../..#..",
    "#####/....#/...#./..#../.#.../#..../#####",
    "##/#./#./#./#./#./##",
    "#..../.#.../.#.../..#../...#./...#./....#",
    "##/.#/.#/.#/.#/.#/##",
    "..#../.#.#./#...#",
    "...../...../...../...../...../...../...../#####",
    "#./.#",
    "..../..../.##./...#/.###/#..#/.###",
    "#.../#.../###./#..#/#..#/#..#/###.",
    "..../..../.##./#..#/#.../#..#/.##.",
    "...#/...#/.###/#..#/#..#/#..#/.###",
    "..../..../.##./#..#/####/#.../.##.",
    "..#/.#./###/.#./.#./.#./.#.",
    "..../..../.###/#..#/#..#/#..#/.###/...#/.##.",
    "#.../#.../###./#..#/#..#/#..#/#..#",
    "#/./#/#/#/#/#",
    ".#/../.#/.#/.#/.#/.#/.#/#.",
    "#.../#.../#..#/#.#./##../#.#./#..#",
    "#./#./#./#./#./#./.#",
    "...../...../##.#./#.#.#/#.#.#/#.#.#/#.#.#",
    "..../..../###./#..#/#..#/#..#/#..#",
    "..../..../.##./#..#/#..#/#..#/.##.",
    "..../..../###./#..#/#..#/#..#/###./#.../#...",
    "..../..../.###/#..#/#..#/#..#/.###/...#/...#",
    ".../.../#.#/##./#../#../#..",
    "..../..../.###/#.../.##./...#/###.",
    ".#./.#./###/.#./.#./.#./..#",
    "..../..../#..#/#..#/#..#/#..#/.###",
    "...../...../#...#/#...#/.#.#./.#.#./..#..",
    "...../...../#...#/#.#.#/#.#.#/#.#.#/.#.#.",
    "...../...../#...#/.#.#./..#../.#.#./#...#",
    "..../..../#..#/#..#/#..#/#..#/.###/...#/.##.",
    "..../..../####/...#/.##./#.../####",
    "..#/.#./.#./#../.#./.#./..#",
    "#/#/#/#/#/#/#/#",
    "#../.#./.#./..#/.#./.#./#..",
    "...../...../.#.../#.#.#/...#."
    // clang-format on
};

constexpr double dotPitch = 0.115;   // em
constexpr double baselineRow = 6;    // the row that stands on the baseline
constexpr double spaceColumns = 2;   // width of a space, less the gap
constexpr double gapColumns = 1.25;  // between two glyphs

class Glyph {
  public:
    explicit Glyph(std::string_view rows) : rows_(rows), columns_(std::min(rows.find('/'), rows.size())) {}

    [[nodiscard]] size_t columns() const { return columns_; }
    [[nodiscard]] size_t rows() const { return (rows_.size() + 1) / (columns_ + 1); }
    [[nodiscard]] bool dot(size_t row, size_t column) const {
        return row < rows() && column < columns_ && rows_[row * (columns_ + 1) + column] == '#';
    }

  private:
    std::string_view rows_;
    size_t columns_;
};

// The glyphs of a UTF-8 text, nothing for a space, '?' once for each character beyond ASCII.
std::vector<std::optional<Glyph>> glyphsOf(std::string_view text) {
    std::vector<std::optional<Glyph>> glyphs;
    for (const char c : text) {
        if ((static_cast<uint8_t>(c) & 0xC0) == 0x80) continue;
        if (c == ' ') {
            glyphs.emplace_back();
        } else {
            const char known = c > ' ' && c <= '~' ? c : '?';
            glyphs.emplace_back(Glyph(face[static_cast<size_t>(known - '!')]));
        }
    }
    return glyphs;
}

double columnsOf(const std::optional<Glyph>& glyph) {
    return glyph ? static_cast<double>(glyph->columns()) : spaceColumns;
}

double width(const std::vector<std::optional<Glyph>>& glyphs) {
    double columns = 0;
    for (const auto& glyph : glyphs) columns += columnsOf(glyph) + gapColumns;
    return columns > 0 ? columns - gapColumns : 0;
}

// Where text runs: the place of its first dot's column on the baseline, and the length of a dot step.
struct Pen {
    Pixel origin;
    double pitch;
    bool upward;

    [[nodiscard]] Pixel at(double column, double row) const {
        const double along = column * pitch;
        const double down = (row - baselineRow) * pitch;
        if (upward) return {origin.x + down, origin.y - along};
        return {origin.x + along, origin.y + down};
    }
};

// Dots join to the right and below; aslant only where no straight stroke already leads there.
void drawGlyph(Canvas& canvas, const Glyph& g, double left, const Pen& pen, double stroke, Colour colour) {
    for (size_t row = 0; row < g.rows(); ++row) {
        for (size_t column = 0; column < g.columns(); ++column) {
            if (!g.dot(row, column)) continue;
            const bool right = g.dot(row, column + 1);
            const bool below = g.dot(row + 1, column);
            const bool before = column > 0 && g.dot(row, column - 1);
            const auto strokeTo = [&](double c, double r) {
                const double x = left + static_cast<double>(column);
                const auto y = static_cast<double>(row);
                canvas.strokeLine(pen.at(x, y), pen.at(x + c, y + r), stroke, colour);
            };
            if (right) strokeTo(1, 0);
            if (below) strokeTo(0, 1);
            if (!right && !below && g.dot(row + 1, column + 1)) strokeTo(1, 1);
            if (!before && !below && column > 0 && g.dot(row + 1, column - 1)) strokeTo(-1, 1);
            if (!right && !below) strokeTo(0, 0);
        }
    }
}

constexpr Colour paper{255, 255, 255};

Colour inkColour(report::Ink ink) {
    switch (ink) {
        case report::Ink::text:
            return {27, 31, 36};
        case report::Ink::faint:
            return {87, 96, 106};
        default:
            return {208, 215, 222};
    }
}

class Painter {
  public:
    Painter(Canvas& canvas, double scale) : canvas_(canvas), scale_(scale) {}

    void operator()(const report::Rect& r) const {
        canvas_.fillRect(r.x * scale_, r.y * scale_, r.width * scale_, r.height * scale_, r.fill);
    }
    void operator()(const report::Line& l) const {
        canvas_.strokeLine(pixel(l.x0, l.y0), pixel(l.x1, l.y1), l.width * scale_, inkColour(l.ink));
    }
    void operator()(const report::Polyline& p) const {
        for (size_t i = 1; i < p.points.size(); ++i) {
            canvas_.strokeLine(pixel(p.points[i - 1].first, p.points[i - 1].second),
                               pixel(p.points[i].first, p.points[i].second), p.width * scale_, p.colour);
        }
    }
    void operator()(const report::Dot& d) const {
        canvas_.fillDot(pixel(d.x, d.y), d.radius * scale_, d.fill);
    }
    void operator()(const report::Text& t) const {
        drawText(canvas_, t.text, pixel(t.x, t.y), t.size * scale_, t.anchor, inkColour(t.ink), t.bold,
                 t.upward);
    }

  private:
    [[nodiscard]] Pixel pixel(double x, double y) const { return {x * scale_, y * scale_}; }

    Canvas& canvas_;
    double scale_;
};

}  // namespace

double letteringWidth(std::string_view text, double size) {
    return width(glyphsOf(text)) * dotPitch * size;
}

void drawText(Canvas& canvas, std::string_view text, Pixel at, double size, report::Anchor anchor,
              Colour colour, bool bold, bool upward) {
    const auto glyphs = glyphsOf(text);
    const double share = anchor == report::Anchor::start ? 0 : anchor == report::Anchor::middle ? 0.5 : 1;
    const double back = share * width(glyphs) * dotPitch * size;
    const Pen pen{upward ? Pixel{at.x, at.y + back} : Pixel{at.x - back, at.y}, dotPitch * size, upward};
    const double stroke = size * (bold ? 0.13 : 0.085);
    double left = 0.5;
    for (const auto& glyph : glyphs) {
        if (glyph) drawGlyph(canvas, *glyph, left, pen, stroke, colour);
        left += columnsOf(glyph) + gapColumns;
    }
}

Canvas paint(const report::Drawing& drawing, double scale) {
    Canvas canvas(static_cast<uint32_t>(std::ceil(drawing.width * scale)),
                  static_cast<uint32_t>(std::ceil(drawing.height * scale)), paper);
    for (const report::Shape& shape : drawing.shapes) std::visit(Painter(canvas, scale), shape);
    return canvas;
}

}  // namespace filigree::jobs
