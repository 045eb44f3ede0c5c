#include "filigree/report/page.h"

#include "report/assets.h"
#include "report/text.h"

#include <algorithm>

#include <fmt/format.h>

namespace filigree::report {

namespace {

// Nothing may be fetched: pictures are data URIs, style and script stand in the page.
constexpr const char* pageHead = R"(<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'">
)";

std::string commandHtml(const std::string& command) {
    return command.empty() ? "" : fmt::format("<code>{}</code>", escapeHtml(command));
}

std::string contentHtml(const Drawing& drawing) {
    return "<div class=\"scroll\">" + toSvg(drawing) + "</div>";
}

std::string contentHtml(const Picture& p) {
    const std::string url = relativeUrl(p.file);
    if (p.png.empty()) return fmt::format("<p><a href=\"{}\">{}</a></p>", url, escapeHtml(p.file));
    const std::string image = fmt::format(
        "<img src=\"data:image/png;base64,{}\" alt=\"{}\" width=\"{}\" height=\"{}\"{}>", base64(p.png),
        escapeHtml(p.alt), p.width, p.height, p.pixelated ? " class=\"pixelated\"" : "");
    return p.file.empty() ? image : fmt::format("<a href=\"{}\">{}</a>", url, image);
}

std::string contentHtml(const Figure& figure) {
    const std::string content = std::visit([](const auto& c) { return contentHtml(c); }, figure.content);
    if (!figure.narrow) return content;
    return "<div class=\"wide\">" + content + "</div><div class=\"narrow\">" + contentHtml(*figure.narrow) +
           "</div>";
}

std::string blockHtml(const Figure& figure) {
    const std::string scale =
        figure.scale ? "<div class=\"scale\">" + toSvg(layOut(*figure.scale)) + "</div>" : "";
    return fmt::format("<figure>{}{}<figcaption>{}</figcaption>{}</figure>\n", contentHtml(figure), scale,
                       escapeHtml(figure.caption), commandHtml(figure.command));
}

// A command that made all figures stands once, below them.
std::string blockHtml(const FigureRow& row) {
    const auto isShared = [&](const Figure& f) { return f.command == row.figures.front().command; };
    if (row.figures.empty()) return "";
    const bool once = std::ranges::all_of(row.figures, isShared);
    std::string out = "<figure>\n<div class=\"row\">\n";
    for (Figure figure : row.figures) {
        if (once) figure.command.clear();
        out += blockHtml(figure);
    }
    return out + "</div>\n" + (once ? commandHtml(row.figures.front().command) : "") + "</figure>\n";
}

std::string blockHtml(const Paragraph& paragraph) {
    return fmt::format("<p>{}</p>\n", escapeHtml(paragraph.text));
}

std::string blockHtml(const Table& table) {
    return toHtml(table);
}

std::string blockHtml(const Legend& legend) {
    std::string out = "<ul class=\"legend\">\n";
    for (const Swatch& s : legend.swatches) {
        out += fmt::format("<li><i class=\"swatch\" style=\"background:#{:02x}{:02x}{:02x}\"></i>{}</li>\n",
                           s.colour.r, s.colour.g, s.colour.b, escapeHtml(s.label));
    }
    return out + "</ul>\n";
}

std::string blockHtml(const Links& links) {
    std::string out = "<ul>\n";
    for (const auto& link : links.links) {
        out += fmt::format("<li><a href=\"{}\">{}</a>: {}</li>\n", relativeUrl(link.file),
                           escapeHtml(link.file), escapeHtml(link.text));
    }
    return out + "</ul>\n";
}

std::string blockHtml(const MapView& view) {
    return toHtml(view);
}

std::string itemHtml(const Gallery::Item& item, bool isOpen) {
    std::string out =
        fmt::format("<details class=\"item\"{}><summary>{}<span>{}</span></summary>\n<div class=\"tiles\">\n",
                    isOpen ? " open" : "", escapeHtml(item.title), escapeHtml(item.note));
    for (const Gallery::Tile& tile : item.tiles) {
        out += fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n", contentHtml(tile.picture),
                           escapeHtml(tile.caption));
    }
    return out + "</div></details>\n";
}

std::string blockHtml(const Gallery& gallery) {
    std::string out = "<figure>\n";
    for (size_t k = 0; k < gallery.items.size(); ++k) out += itemHtml(gallery.items[k], k < gallery.open);
    return out + commandHtml(gallery.command) + "</figure>\n";
}

bool holdsMapView(const Page& page) {
    return std::ranges::any_of(page.sections, [](const Section& section) {
        return std::ranges::any_of(section.blocks,
                                   [](const Block& block) { return std::holds_alternative<MapView>(block); });
    });
}

// Only what the page's blocks need.
std::string styleOf(const Page& page) {
    std::string style(page_css);
    if (holdsMapView(page)) style += map_view_css;
    return style;
}

// One scope for all, so that nothing meets the names of browsers.
std::string scriptOf(const Page& page) {
    std::string script = "'use strict';\n(() => {\n";
    for (const auto part : {page_js}) script += part;
    if (holdsMapView(page)) {
        for (const auto part :
             {curve_js, cells_js, copies_js, raster_js, stage_js, costs_js, panel_js, map_view_js})
            script += part;
    }
    return script + "})();\n";
}

std::string contentsHtml(const Page& page) {
    if (page.sections.size() < 3) return "";
    std::string out = "<nav><ul>\n";
    for (size_t i = 0; i < page.sections.size(); ++i) {
        out += fmt::format("<li><a href=\"#s{}\">{}</a></li>\n", i + 1, escapeHtml(page.sections[i].title));
    }
    return out + "</ul></nav>\n";
}

std::string sectionHtml(const Section& section, size_t number) {
    std::string out = fmt::format("<section id=\"s{}\">\n<h2>{}</h2>\n", number, escapeHtml(section.title));
    for (const Block& block : section.blocks) {
        out += std::visit([](const auto& b) { return blockHtml(b); }, block);
    }
    return out + "</section>\n";
}

template <class Chart>
Figure layOutTwice(const Chart& chart, std::string caption, std::string command) {
    return {layOut(chart), std::move(caption), std::move(command), layOut(chart, 350, 300)};
}

}  // namespace

Figure chartFigure(const BarChart& chart, std::string caption, std::string command) {
    return layOutTwice(chart, std::move(caption), std::move(command));
}

Figure chartFigure(const LineChart& chart, std::string caption, std::string command) {
    return layOutTwice(chart, std::move(caption), std::move(command));
}

Figure chartFigure(const ScatterChart& chart, std::string caption, std::string command) {
    return layOutTwice(chart, std::move(caption), std::move(command));
}

std::string toHtml(const Page& page) {
    std::string out = fmt::format(
        "<!DOCTYPE html>\n<html "
        "lang=\"en\">\n<head>\n{}<title>{}</title>\n<style>{}</style>\n</head>\n<body>\n<main>\n",
        pageHead, escapeHtml(page.title), styleOf(page));
    out += fmt::format("<h1>{}</h1>\n", escapeHtml(page.title));
    if (!page.lead.empty()) out += fmt::format("<p class=\"lead\">{}</p>\n", escapeHtml(page.lead));
    out += contentsHtml(page);
    for (size_t i = 0; i < page.sections.size(); ++i) out += sectionHtml(page.sections[i], i + 1);
    return out + "</main>\n<script>" + scriptOf(page) + "</script>\n</body>\n</html>\n";
}

}  // namespace filigree::report
