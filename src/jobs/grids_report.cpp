#include "filigree/jobs/grids.h"

#include "jobs/json_text.h"

#include <algorithm>

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

// What decides the error: the finest step. 0 where vertices are not on a lattice.
double stepOf(const GridsSummary& s) {
    return s.codec == grid::Codec::paper ? 0 : *std::ranges::min_element(s.lattice.step);
}

double perTriangle(const GridsSummary& s, uint64_t bytes) {
    return static_cast<double>(bytes) / static_cast<double>(s.statistics.triangles);
}

}  // namespace

report::Table gridMemoryTable(const GridsSummary& s) {
    using report::Show;
    report::Table table;
    table.caption = "Memory";
    table.columns = {{"part", "part"},
                     {"bytes", "bytes", "", Show::bytes},
                     {"bytes_per_triangle", "B/triangle", "", Show::plain, 3}};
    const auto add = [&](const char* part, uint64_t bytes) {
        table.rows.push_back({std::string(part), static_cast<int64_t>(bytes), perTriangle(s, bytes)});
    };
    add("geometry", s.bytes.geometry);
    add("clusters", s.bytes.clusters);
    add("BVH", s.bytes.bvh);
    add("total", s.bytes.total());
    add("attributes, not in total", s.attributeBytes);
    return table;
}

report::Table gridErrorTable(const GridsSummary& s) {
    report::Table table;
    table.caption = "Error";
    table.columns = {{"error", "error"}, {"mean", "mean"}, {"max", "max"}};
    const auto small = [](double value) { return fmt::format("{:.3g}", value); };
    const auto& e = s.errors;
    table.rows = {
        {std::string("all vertices, RMS, world units"), small(e.all.rms), small(e.all.max)},
        {std::string("the same over the scene's diagonal"), small(e.all.rms / s.diagonal),
         small(e.all.max / s.diagonal)},
        {std::string("sub-grids, % of their diagonal"), small(100 * e.subGridMean),
         small(100 * e.subGridMax)},
    };
    return table;
}

report::Table gridSizeTable(const GridsSummary& s) {
    report::Table table;
    table.caption = "Grids by their shorter side";
    table.columns = {{"quads", "quads a side"},
                     {"grids", "grids"},
                     {"quads_in", "quads in them"},
                     {"share", "of all triangles", "", report::Show::share}};
    for (const grid::GridSizeClass& c : s.statistics.classes) {
        table.rows.push_back(
            {fmt::format("{} to {}", c.side, 2 * c.side - 1), static_cast<int64_t>(c.grids),
             static_cast<int64_t>(c.quads),
             2 * static_cast<double>(c.quads) / static_cast<double>(s.statistics.triangles)});
    }
    return table;
}

std::string toJson(const GridsSummary& s) {
    const auto& e = s.errors;
    return dump({{"triangles", s.statistics.triangles},
                 {"grids", s.grids},
                 {"in_grid_share", s.statistics.inGridShare()},
                 {"clusters", s.clusters},
                 {"codec", nameOf(s.codec)},
                 {"step", stepOf(s)},
                 {"bytes",
                  {{"geometry", s.bytes.geometry},
                   {"bvh", s.bytes.bvh},
                   {"clusters", s.bytes.clusters},
                   {"attributes", s.attributeBytes},
                   {"total", s.bytes.total()}}},
                 {"bytes_per_triangle", s.bytesPerTriangle()},
                 {"error",
                  {{"rms", e.all.rms},
                   {"max", e.all.max},
                   {"rms_over_diagonal", e.all.rms / s.diagonal},
                   {"max_over_diagonal", e.all.max / s.diagonal},
                   {"subgrid_percent_mean", 100 * e.subGridMean},
                   {"subgrid_percent_max", 100 * e.subGridMax}}},
                 {"seconds",
                  {{"convert", s.convertSeconds}, {"encode", s.encodeSeconds}, {"build", s.buildSeconds}}}});
}

}  // namespace filigree::jobs
