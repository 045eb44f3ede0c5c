#include "jobs/grids_page.h"

#include "filigree/report/number.h"

#include "jobs/command_words.h"
#include "jobs/grid_error_map.h"
#include "jobs/page_parts.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

// Twelve bytes a vertex and twelve a triangle.
uint64_t indexedBytes(const grid::GridMesh& mesh) {
    return 12 * (mesh.vertices.size() + mesh.looseVertices.size() + mesh.triangleCount());
}

report::BarChart memoryChart(const GridsSummary& s, const grid::GridMesh& mesh) {
    const auto perTriangle = [&](uint64_t bytes) {
        return static_cast<double>(bytes) / static_cast<double>(s.statistics.triangles);
    };
    report::BarChart chart;
    chart.title = "Memory";
    chart.y = {"bytes a triangle"};
    chart.categories = {"vertices and indices", "these grids"};
    chart.stacked = true;
    chart.series = {
        {"uncompressed, no hierarchy", {perTriangle(indexedBytes(mesh)), 0}, report::seriesColour(7)},
        {"records of grids", {0, perTriangle(s.bytes.geometry)}, report::seriesColour(0)},
        {"clusters", {0, perTriangle(s.bytes.clusters)}, report::seriesColour(1)},
        {"hierarchy", {0, perTriangle(s.bytes.bvh)}, report::seriesColour(2)}};
    return chart;
}

report::BarChart sizeChart(const GridsSummary& s) {
    report::BarChart chart;
    chart.title = "Triangles by the size of their grid";
    chart.x = {"shorter side of the grid", "quads"};
    chart.y = {"of all triangles"};
    chart.y.share = true;
    chart.categories = {"none"};
    chart.series = {{"", {1 - s.statistics.inGridShare()}, report::seriesColour(2)}};
    for (const grid::GridSizeClass& c : s.statistics.classes) {
        chart.categories.push_back(c.side == 1 ? "1" : fmt::format("{}-{}", c.side, 2 * c.side - 1));
        chart.series[0].values.push_back(2 * static_cast<double>(c.quads) /
                                         static_cast<double>(s.statistics.triangles));
    }
    return chart;
}

// Sub-grids by their error against their diagonal, in bins that double.
report::BarChart errorChart(const GridViewSource& source) {
    constexpr double firstBin = 1e-5;  // up to here, from 0 on
    constexpr size_t bins = 15;
    report::BarChart chart;
    chart.title = "Sub-grids by their error";
    chart.x = {"error up to", "% of the diagonal"};
    chart.y = {"sub-grids"};
    chart.y.share = true;
    std::vector<double> counts(bins);
    double all = 0;
    for (uint32_t k = 0; k < source.mesh.grids.size(); ++k) {
        for (const float share : grid::subGridShares(source.mesh, source.decoded, k).shares) {
            const double bin = share > firstBin ? std::ceil(std::log2(share / firstBin)) : 0;
            ++counts[std::min(static_cast<size_t>(bin), bins - 1)];
            ++all;
        }
    }
    for (size_t k = 0; k < bins; ++k) {
        chart.categories.push_back(report::formatCompact(100 * firstBin * std::exp2(k)));
        if (all > 0) counts[k] /= all;
    }
    chart.categories.back() = "more";
    chart.series = {{"", std::move(counts), report::seriesColour(3)}};
    return chart;
}

report::Table timeTable(const GridsSummary& s) {
    const auto seconds = [](double value) { return fmt::format("{:.2f} s", value); };
    return factTable("Seconds", "",
                     {{"Read", seconds(s.readSeconds)},
                      {"Find grids, choose the lattice", seconds(s.convertSeconds)},
                      {"Encode", seconds(s.encodeSeconds)},
                      {"Build the hierarchy", seconds(s.buildSeconds)}});
}

std::string leadOf(const GridsSummary& s) {
    return fmt::format("{} triangles in {:.3f} bytes each, which is all that rays need; {} of them in {} {}.",
                       report::formatCount(s.statistics.triangles), s.bytesPerTriangle(),
                       report::formatShare(s.statistics.inGridShare()), report::formatCount(s.grids),
                       s.grids == 1 ? "grid" : "grids");
}

std::string piecesCaption(grid::Codec codec) {
    const char* const parts =
        codec == grid::Codec::paper ? "sub-grids of 4 x 4 quads" : "tiles of 16 x 16 quads";
    return fmt::format(
        "Each grid has a colour of its own, light and dark by its {}. Triangles of clusters, "
        "which fit no grid, are grey.",
        parts);
}

Result<report::Section> surfaceSection(const GridViews& views, grid::Codec codec,
                                       const std::string& command) {
    auto lit = pictureOf(views.lit, "The decoded surface under sun and sky");
    if (!lit) return lit.error();
    auto pieces = pictureOf(views.pieces, "The surface, a colour for each grid");
    if (!pieces) return pieces.error();
    report::FigureRow row;
    row.figures.push_back(
        {std::move(*lit), "Sun and sky; every ray is traced through the compressed records.", command});
    row.figures.push_back({std::move(*pieces), piecesCaption(codec), command});
    return report::Section{"The surface", {std::move(row)}};
}

Result<report::Section> errorSection(const GridViews& views, const GridsSummary& s,
                                     const GridViewSource& source, const std::string& command) {
    auto surface = pictureOf(views.error, "The surface in the colours of its error");
    if (!surface) return surface.error();
    HeatPanel flat = gridErrorPanel(source.mesh, source.decoded, s.codec);
    auto map = pictureOf(flat.picture, "The errors of all sub-grids, side by side");
    if (!map) return map.error();
    map->pixelated = true;
    report::Section section{"Error", {}};
    report::Figure view{
        std::move(*surface),
        "The largest error of each 5 x 5 vertices against the diagonal of their box (table 3 of "
        "Benthin and others 2021), on the surface; light and shade of it darken the colours. "
        "Triangles of clusters count against their own box.",
        command};
    view.scale = views.scale;
    view.scale->note = fmt::format("mean {}, largest {}", report::formatShare(s.errors.subGridMean),
                                   report::formatShare(s.errors.subGridMax));
    section.blocks.emplace_back(std::move(view));
    report::Table errors = gridErrorTable(s);
    errors.command = command;
    section.blocks.emplace_back(std::move(errors));
    report::Figure sheet{std::move(*map),
                         "The same, flat: a pixel a sub-grid, grids side by side. --error-map writes it as a "
                         "file.",
                         command};
    sheet.scale = std::move(flat.scale);
    report::FigureRow row;
    row.figures.push_back(std::move(sheet));
    row.figures.push_back(report::chartFigure(
        errorChart(source), "How many sub-grids are how far off; each bar reaches twice as far.", command));
    section.blocks.emplace_back(std::move(row));
    return section;
}

report::Section memorySection(const GridsSummary& s, const grid::GridMesh& mesh, const std::string& command) {
    report::Section section{"Memory", {}};
    report::Table memory = gridMemoryTable(s);
    memory.command = command;
    section.blocks.emplace_back(std::move(memory));
    section.blocks.emplace_back(report::chartFigure(
        memoryChart(s, mesh),
        "12 bytes a vertex and 12 a triangle, before any hierarchy, beside all that rays need of the grids. "
        "filigree bench grids measures what Embree takes.",
        command));
    return section;
}

report::Section conversionSection(const GridsSummary& s, const std::string& command) {
    report::Section section{"The conversion", {}};
    section.blocks.emplace_back(report::chartFigure(
        sizeChart(s), "Large grids take the fewest bytes; triangles in none go into clusters.", command));
    if (!s.statistics.classes.empty()) section.blocks.emplace_back(gridSizeTable(s));
    section.blocks.emplace_back(timeTable(s));
    return section;
}

}  // namespace

Result<report::Page> makeGridsPage(const GridsOptions& options, const GridsSummary& summary,
                                   const GridViewSource& source, const Executor& executor,
                                   ProgressSink& progress) {
    const auto views = drawGridViews(source, options.width, options.height, executor, progress);
    if (!views) return views.error();
    const std::string command = gridsCommand(options);
    auto surface = surfaceSection(*views, summary.codec, command);
    if (!surface) return surface.error();
    auto errors = errorSection(*views, summary, source, command);
    if (!errors) return errors.error();
    report::Page page;
    page.title = "Compressed grids of " + options.input.filename().string();
    page.lead = leadOf(summary);
    page.sections = {std::move(*surface), std::move(*errors), memorySection(summary, source.mesh, command),
                     conversionSection(summary, command)};
    addNotes(summary.notes, page);
    return page;
}

}  // namespace filigree::jobs
