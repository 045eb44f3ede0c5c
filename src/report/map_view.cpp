#include "filigree/report/map_view.h"

#include "report/packed.h"
#include "report/text.h"

#include <algorithm>
#include <bit>
#include <nlohmann/json.hpp>

#include <fmt/format.h>

namespace filigree::report {

namespace {

using Json = nlohmann::ordered_json;

uint32_t cut(uint64_t value) {
    return static_cast<uint32_t>(std::min<uint64_t>(value, UINT32_MAX));
}

const char* edgeName(Edge edge) {
    switch (edge) {
        case Edge::repeat:
            return "repeat";
        case Edge::mirror:
            return "mirror";
        default:
            return "clamp";
    }
}

Json metaOf(const MappedTexture& t) {
    return {{"name", validUtf8(t.name)},
            {"note", validUtf8(t.note)},
            {"width", t.width},
            {"height", t.height},
            {"wrap", {edgeName(t.edges[0]), edgeName(t.edges[1])}},
            {"nearest", t.nearest},
            {"triangles", t.triangles},
            {"shown", t.shownTriangles},
            {"maps", t.maps},
            {"overlaps", t.mostOverlaps},
            {"shares", t.shares}};
}

Json metaOf(const MapView& view) {
    Json json;
    for (const State& state : view.states) {
        const Colour c = state.colour;
        json["kinds"].push_back({{"name", validUtf8(state.name)}, {"colour", {c.r, c.g, c.b}}});
    }
    json["textures"] = Json::array();
    for (const MappedTexture& texture : view.textures) json["textures"].push_back(metaOf(texture));
    return json;
}

// JSON that no text in it can end: "</script" needs the '<'.
std::string scriptSafe(const Json& json) {
    std::string out;
    for (const char c : json.dump()) out += c == '<' ? std::string("\\u003c") : std::string(1, c);
    return out;
}

std::string blob(const char* name, const std::string& text) {
    return fmt::format("<script type=\"text/plain\" class=\"{}\">{}</script>\n", name, text);
}

}  // namespace

std::string packMaps(std::span<const CellMap> maps) {
    ColumnWriter columns;
    const auto add = [&](auto value) {
        columns.column(maps.size(), [&](size_t k) { return cut(value(maps[k])); });
    };
    add([](const CellMap& m) { return m.record; });
    add([](const CellMap& m) { return m.storedLevel; });
    add([](const CellMap& m) { return m.level; });
    add([](const CellMap& m) { return m.states; });
    add([](const CellMap& m) { return m.bytes; });
    add([](const CellMap& m) { return m.sharers; });
    for (size_t s = 0; s < 4; ++s) add([s](const CellMap& m) { return m.cells[s]; });
    add([](const CellMap& m) { return m.inner.size() / 2; });
    add([](const CellMap& m) { return m.finest.size(); });
    for (const CellMap& map : maps) columns.append(map.inner);
    for (const CellMap& map : maps) columns.append(map.finest);
    return packed(columns.bytes());
}

std::string packTriangles(std::span<const PlacedTriangle> triangles) {
    ColumnWriter columns;
    const auto add = [&](auto value) {
        columns.column(triangles.size(), [&](size_t k) { return value(triangles[k]); });
    };
    for (size_t c = 0; c < 6; ++c)
        add([c](const PlacedTriangle& t) { return std::bit_cast<uint32_t>(t.uv[c]); });
    add([](const PlacedTriangle& t) { return static_cast<uint32_t>(t.map); });
    add([](const PlacedTriangle& t) { return cut(t.equals); });
    add([](const PlacedTriangle& t) { return t.mesh; });
    add([](const PlacedTriangle& t) { return t.primitive; });
    add([](const PlacedTriangle& t) { return t.triangle; });
    return packed(columns.bytes());
}

std::string toHtml(const MapView& view) {
    std::string out =
        "<figure>\n<div class=\"map-view\">\n<noscript><p>This view needs a script.</p></noscript>\n";
    out += fmt::format("<script type=\"application/json\" class=\"meta\">{}</script>\n",
                       scriptSafe(metaOf(view)));
    for (const MappedTexture& t : view.textures) {
        out +=
            blob("alpha", base64(t.png)) + blob("triangles", t.packedTriangles) + blob("maps", t.packedMaps);
    }
    const std::string command =
        view.command.empty() ? "" : fmt::format("<code>{}</code>", escapeHtml(view.command));
    return out +
           fmt::format("</div>\n<figcaption>{}</figcaption>{}</figure>\n", escapeHtml(view.caption), command);
}

}  // namespace filigree::report
