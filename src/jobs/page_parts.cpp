#include "jobs/page_parts.h"

#include "filigree/io/image_file.h"

#include <algorithm>
#include <array>
#include <utility>

namespace filigree::jobs {
namespace {

Result<report::Picture> embedded(Result<std::vector<uint8_t>> png, uint32_t width, uint32_t height,
                                 const std::string& alt) {
    if (!png) return png.error();
    return report::Picture{std::move(*png), width, height, alt, ""};
}

}  // namespace

report::Colour methodColour(std::string_view method) {
    static constexpr std::array<std::pair<std::string_view, size_t>, 13> colours{{{"flat", 0},
                                                                                  {"micromap", 0},
                                                                                  {"gruen", 7},
                                                                                  {"bitmask", 2},
                                                                                  {"tree", 3},
                                                                                  {"indexed-tree", 4},
                                                                                  {"dag", 5},
                                                                                  {"sdag", 1},
                                                                                  {"texture", 7},
                                                                                  {"vq2", 4},
                                                                                  {"vq4", 2},
                                                                                  {"vq2+", 5},
                                                                                  {"vq4+", 3}}};
    const auto found = std::ranges::find(colours, method, &std::pair<std::string_view, size_t>::first);
    return report::seriesColour(found == colours.end() ? 6 : found->second);
}

Result<report::Picture> pictureOf(const Canvas& canvas, const std::string& alt) {
    return embedded(canvas.png(), canvas.width(), canvas.height(), alt);
}

Result<report::Picture> pictureOf(const scene::ColourImage& image, const std::string& alt) {
    return embedded(io::encodePng(image), image.width, image.height, alt);
}

void addNotes(const std::vector<std::string>& notes, report::Page& page) {
    if (notes.empty()) return;
    report::Section section{"Notes", {}};
    for (const std::string& note : notes) section.blocks.emplace_back(report::Paragraph{note});
    page.sections.push_back(std::move(section));
}

report::Table factTable(const std::string& caption, const std::string& command,
                        std::vector<std::vector<report::Cell>> rows) {
    report::Table table;
    table.caption = caption;
    table.command = command;
    table.columns = {{"what", "What"}, {"value", "Value"}};
    table.rows = std::move(rows);
    return table;
}

}  // namespace filigree::jobs
