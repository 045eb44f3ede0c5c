#include "filigree/report/drawing.h"

#include "report/text.h"

#include <cmath>

#include <fmt/format.h>

namespace filigree::report {

namespace {

// Hundredths are finer than any screen and keep the file small.
std::string number(double value) {
    std::string text = fmt::format("{:.2f}", value);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.ends_with('.')) text.pop_back();
    return text == "-0" ? "0" : text;
}

std::string hex(Colour c) {
    return fmt::format("#{:02x}{:02x}{:02x}", c.r, c.g, c.b);
}

const char* inkClass(Ink ink) {
    switch (ink) {
        case Ink::text:
            return "t";
        case Ink::faint:
            return "f";
        default:
            return "g";
    }
}

const char* anchorName(Anchor anchor) {
    switch (anchor) {
        case Anchor::start:
            return "start";
        case Anchor::middle:
            return "middle";
        default:
            return "end";
    }
}

std::string withHint(const std::string& element, const std::string& name, const std::string& hint) {
    if (hint.empty()) return element + "/>\n";
    return fmt::format("{}><title>{}</title></{}>\n", element, escapeHtml(hint), name);
}

std::string svgOf(const Rect& r) {
    return withHint(fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\"{}",
                                number(r.x), number(r.y), number(r.width), number(r.height), hex(r.fill),
                                r.outlined ? " class=\"d\"" : ""),
                    "rect", r.hint);
}

std::string svgOf(const Line& l) {
    return fmt::format("<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\" class=\"l{}\" stroke-width=\"{}\"/>\n",
                       number(l.x0), number(l.y0), number(l.x1), number(l.y1), inkClass(l.ink),
                       number(l.width));
}

std::string svgOf(const Polyline& p) {
    std::string points;
    for (const auto& [x, y] : p.points) points += fmt::format("{},{} ", number(x), number(y));
    if (!points.empty()) points.pop_back();
    return fmt::format(
        "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" "
        "stroke-linejoin=\"round\"{}/>\n",
        points, hex(p.colour), number(p.width), p.dashed ? " stroke-dasharray=\"6 4\"" : "");
}

std::string svgOf(const Dot& d) {
    const std::string colour = hex(d.fill);
    const std::string paint =
        d.hollow
            ? fmt::format("fill=\"{}\" fill-opacity=\".15\" stroke=\"{}\" stroke-width=\"2\"", colour, colour)
            : fmt::format("fill=\"{}\" class=\"d\"", colour);
    return withHint(fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\" {}", number(d.x), number(d.y),
                                number(d.radius), paint),
                    "circle", d.hint);
}

std::string svgOf(const Text& t) {
    const std::string turn =
        t.upward ? fmt::format(" transform=\"rotate(-90 {} {})\"", number(t.x), number(t.y)) : "";
    return fmt::format(
        "<text x=\"{}\" y=\"{}\" font-size=\"{}\" text-anchor=\"{}\" class=\"{}\"{}{}>{}</text>\n",
        number(t.x), number(t.y), number(t.size), anchorName(t.anchor), inkClass(t.ink),
        t.bold ? " font-weight=\"600\"" : "", turn, escapeHtml(t.text));
}

// The classes are one letter because a page may hold dozens of drawings; `.fg` keeps them to drawings.
constexpr const char* style =
    "<style>"
    ".fg text{font-family:system-ui,-apple-system,'Segoe UI',Roboto,'DejaVu Sans',sans-serif}"
    ".fg .t{fill:#1b1f24}.fg .f{fill:#57606a}.fg .g{fill:#d0d7de}"
    ".fg .lt{stroke:#1b1f24}.fg .lf{stroke:#57606a}.fg .lg{stroke:#d0d7de}"
    ".fg .d{stroke:#1b1f24;stroke-opacity:.45;stroke-width:.75}"
    "@media (prefers-color-scheme:dark){"
    ".fg .t{fill:#e6edf3}.fg .f{fill:#9aa6b2}.fg .g{fill:#3a424c}"
    ".fg .lt{stroke:#e6edf3}.fg .lf{stroke:#9aa6b2}.fg .lg{stroke:#3a424c}"
    ".fg .d{stroke:#e6edf3;stroke-opacity:.35}}"
    "</style>\n";

}  // namespace

// 0.57 em a character is a little wide for the usual sans-serifs, so nothing laid out by it is cut off.
double textWidth(const std::string& text, double size) {
    size_t characters = 0;
    for (const char c : text) characters += (static_cast<uint8_t>(c) & 0xC0) != 0x80 ? 1 : 0;
    return 0.57 * size * static_cast<double>(characters);
}

std::string toSvg(const Drawing& drawing) {
    std::string out = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"fg\" role=\"img\" viewBox=\"0 0 {0} {1}\" "
        "width=\"{0}\" height=\"{1}\" style=\"max-width:100%;height:auto\">\n",
        number(drawing.width), number(drawing.height));
    out += fmt::format("<title>{}</title>\n", escapeHtml(drawing.title));
    out += style;
    for (const Shape& shape : drawing.shapes) {
        out += std::visit([](const auto& s) { return svgOf(s); }, shape);
    }
    return out + "</svg>\n";
}

}  // namespace filigree::report
