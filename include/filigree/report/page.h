// One self-contained HTML page: it fetches nothing, and follows the reader's light or dark theme.
#pragma once

#include "filigree/report/chart.h"
#include "filigree/report/colour_scale.h"
#include "filigree/report/drawing.h"
#include "filigree/report/map_view.h"
#include "filigree/report/table.h"

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace filigree::report {

// A picture that travels inside the page.
struct Picture {
    std::vector<uint8_t> png;  // the file's bytes; empty shows a link to `file` alone
    uint32_t width = 0;        // pixels
    uint32_t height = 0;
    std::string alt;         // what it shows, for readers that cannot see it
    std::string file;        // the same picture beside the page, as a relative path; empty for none
    bool pixelated = false;  // enlarged with hard edges
};

struct Figure {
    std::variant<Picture, Drawing> content;
    std::string caption;
    std::string command;                 // that makes it again; empty for none
    std::optional<Drawing> narrow{};     // in place of a Drawing in narrow windows
    std::optional<ColourScale> scale{};  // what the colours of a Picture mean
};

// A chart laid out for wide windows and for phones.
Figure chartFigure(const BarChart& chart, std::string caption, std::string command);
Figure chartFigure(const LineChart& chart, std::string caption, std::string command);
Figure chartFigure(const ScatterChart& chart, std::string caption, std::string command);

// Figures beside each other where the window is wide enough.
struct FigureRow {
    std::vector<Figure> figures;
};

struct Paragraph {
    std::string text;
};

// One labelled colour of a legend.
struct Swatch {
    Colour colour;
    std::string label;
};
struct Legend {
    std::vector<Swatch> swatches;
};

// Names of files beside the page, as relative paths, with what each holds.
struct Links {
    struct Link {
        std::string file;
        std::string text;
    };
    std::vector<Link> links;
};

// Many small pictures, in rows that open one by one.
struct Gallery {
    struct Tile {
        Picture picture;
        std::string caption;
    };
    struct Item {
        std::string title;
        std::string note;  // beside the title; empty for none
        std::vector<Tile> tiles;
    };
    std::vector<Item> items;
    size_t open = 1;      // of the first items, at the start
    std::string command;  // that makes it again; empty for none
};

using Block = std::variant<Paragraph, Table, Figure, FigureRow, Legend, Links, MapView, Gallery>;

struct Section {
    std::string title;
    std::vector<Block> blocks;
};

struct Page {
    std::string title;
    std::string lead;  // one paragraph below the title; empty for none
    std::vector<Section> sections;
};

// The whole document. All texts are escaped.
std::string toHtml(const Page& page);

}  // namespace filigree::report
