#include "jobs/demo_terrain.h"

#include "filigree/core/file.h"
#include "filigree/grid/error.h"
#include "filigree/grid/shapes.h"
#include "filigree/io/image_file.h"
#include "filigree/report/number.h"

#include "jobs/command_words.h"
#include "jobs/demo_views.h"

#include <cassert>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

constexpr uint32_t heightfieldSide = 1025;  // vertices, a cell of 1 apart
constexpr double heightScale = 0.005;       // a grey step, so that hills keep their shape
constexpr const char* heightsFile = "terrain.png";
constexpr const char* gridsFile = "terrain.fil";
constexpr const char* viewFile = "terrain-view.png";
constexpr const char* gridsPageFile = "terrain.html";
constexpr const char* viewPageFile = "terrain-view.html";

// The terrain as a grey image of 16 bits, its lowest vertex black.
Status writeHeights(const std::filesystem::path& file, const Executor& executor) {
    const grid::GridMesh mesh = grid::terrain(heightfieldSide, executor);
    const Box box = grid::boundsOf(mesh);
    const double steps = (heightfieldSide - 1) / heightScale;  // of a unit of height
    assert((box.high[1] - box.low[1]) * steps <= 65535);
    std::vector<uint16_t> greys;
    greys.reserve(mesh.vertices.size());
    for (const Vec3& v : mesh.vertices)
        greys.push_back(static_cast<uint16_t>(std::lround((double{v[1]} - box.low[1]) * steps)));
    const auto png = io::encodeGreyPng(heightfieldSide, heightfieldSide, std::span<const uint16_t>(greys));
    if (!png) return png.error();
    return writeFile(file, *png);
}

report::Table terrainTable(const DemoTerrain& terrain, const std::string& command) {
    const GridsSummary& s = terrain.conversion;
    const auto bytes = [](uint64_t n) { return report::formatBytes(static_cast<double>(n)); };
    report::Table table;
    table.caption = "The terrain, compressed";
    table.command = command;
    table.columns = {{"what", "What"}, {"value", "Value"}};
    table.rows = {{"Triangles", static_cast<int64_t>(s.statistics.triangles)},
                  {"Tiles", bytes(s.bytes.geometry)},
                  {"Hierarchy", bytes(s.bytes.bvh)},
                  {"Bytes a triangle, all that rays need", fmt::format("{:.3f}", s.bytesPerTriangle())},
                  {"Largest error, of the diagonal", fmt::format("{:.1e}", s.errors.all.max / s.diagonal)}};
    return table;
}

}  // namespace

Result<DemoTerrain> drawDemoTerrain(const std::filesystem::path& folder, unsigned samples,
                                    const Executor& executor, ProgressSink& progress) {
    DemoTerrain terrain;
    terrain.heights = folder / heightsFile;
    terrain.grids = folder / gridsFile;
    if (const Status written = writeHeights(terrain.heights, executor); !written) return written.error();

    GridsOptions conversion;
    conversion.input = terrain.heights;
    conversion.output = terrain.grids;
    conversion.heightScale = heightScale;
    conversion.page = folder / gridsPageFile;
    auto converted = grids(conversion, executor, progress);
    if (!converted) return converted.error();
    terrain.conversion = std::move(*converted);

    RenderOptions view;
    view.input = terrain.grids;
    view.output = folder / viewFile;
    view.integrator = "path";
    view.spp = 2 * samples;  // paths are noisier than shadows
    view.page = folder / viewPageFile;
    auto rendered = render(view, executor, progress);
    if (!rendered) return rendered.error();
    terrain.render = std::move(*rendered);
    terrain.files = {viewFile, gridsPageFile, viewPageFile};

    auto figure = figureOf(view.output, "The terrain, path-traced",
                           "Diffuse paths, traced from the compressed tiles.", renderCommand(view));
    if (!figure) return figure.error();
    terrain.section = {"A displaced terrain in tiles", {}};
    terrain.section.blocks.emplace_back(std::move(*figure));
    terrain.section.blocks.emplace_back(terrainTable(terrain, gridsCommand(conversion)));
    terrain.section.blocks.emplace_back(
        report::Links{{{gridsPageFile, "its grids and their error on the surface, charts and tables"},
                       {viewPageFile, "what its rays cost"}}});
    return terrain;
}

}  // namespace filigree::jobs
