#include "filigree/jobs/bench_grids.h"

#include "jobs/json_text.h"

#include <string_view>

namespace filigree::jobs {
namespace {

constexpr std::string_view codecWithoutLeaks = "lattice";

template <class Value>
Json perKind(const BenchGridsRow& row, Value BenchGridsSpeed::*value) {
    return {{"primary", row.primary.*value},
            {"bounce", row.bounce.*value},
            {"ao", row.ao.*value},
            {"shuffled", row.shuffled.*value}};
}

}  // namespace

std::string toJson(const BenchGridsSummary& summary) {
    Json rows = Json::array();
    for (const BenchGridsRow& r : summary.rows) {
        rows.push_back({{"scene", r.scene},
                        {"triangles", r.triangles},
                        {"method", r.method},
                        {"bytes_per_triangle", r.bytesPerTriangle},
                        {"build_seconds", r.buildSeconds},
                        {"cache_bytes", r.cacheBytes},
                        {"primary_mrays", r.primary.mraysPerSecond},
                        {"bounce_mrays", r.bounce.mraysPerSecond},
                        {"ao_mrays", r.ao.mraysPerSecond},
                        {"shuffled_mrays", r.shuffled.mraysPerSecond},
                        {"ratio_primary", r.primary.ratio},
                        {"ratio_bounce", r.bounce.ratio},
                        {"ratio_ao", r.ao.ratio},
                        {"ratio_shuffled", r.shuffled.ratio},
                        {"ratio_to_streams", perKind(r, &BenchGridsSpeed::ratioToStreams)},
                        {"batched", perKind(r, &BenchGridsSpeed::batched)},
                        {"hits", perKind(r, &BenchGridsSpeed::hits)}});
    }
    BenchGridsLeaks lattice;
    Json leaks = Json::array();
    for (const BenchGridsLeaks& l : summary.leaks) {
        leaks.push_back({{"scene", l.scene}, {"method", l.method}, {"rays", l.rays}, {"misses", l.misses}});
        if (l.method != codecWithoutLeaks) continue;
        lattice.rays += l.rays;
        lattice.misses += l.misses;
    }
    return dump({{"rows", rows},
                 {"leaks", {{"rays", lattice.rays}, {"misses", lattice.misses}}},
                 {"leaks_by_method", leaks}});
}

report::Table benchGridsTable(const BenchGridsSummary& summary) {
    using report::Show;
    report::Table table;
    table.caption = "Bytes, build times and speed; ratios to Embree's triangles, above 1 is faster";
    table.columns = {{"scene", "scene"},
                     {"method", "method"},
                     {"triangles", "triangles", "", Show::compact},
                     {"bytes", "bytes a triangle", "", Show::plain, 3},
                     {"build", "build", "s", Show::plain, 3},
                     {"primary", "primary", "Mrays/s", Show::plain, 3},
                     {"ratio_primary", "ratio", "", Show::plain, 3},
                     {"bounce", "bounce", "Mrays/s", Show::plain, 3},
                     {"ratio_bounce", "ratio", "", Show::plain, 3},
                     {"ao", "AO", "Mrays/s", Show::plain, 3},
                     {"ratio_ao", "ratio", "", Show::plain, 3},
                     {"shuffled", "shuffled", "Mrays/s", Show::plain, 3},
                     {"ratio_shuffled", "ratio", "", Show::plain, 3}};
    for (const BenchGridsRow& r : summary.rows) {
        table.rows.push_back({r.scene, r.method, static_cast<int64_t>(r.triangles), r.bytesPerTriangle,
                              r.buildSeconds, r.primary.mraysPerSecond, r.primary.ratio,
                              r.bounce.mraysPerSecond, r.bounce.ratio, r.ao.mraysPerSecond, r.ao.ratio,
                              r.shuffled.mraysPerSecond, r.shuffled.ratio});
    }
    return table;
}

report::Table benchLeaksTable(const BenchGridsSummary& summary) {
    report::Table table;
    table.caption = "Rays from inside closed shapes, and how many got out";
    table.columns = {{"scene", "closed shape"},
                     {"method", "method"},
                     {"rays", "rays at vertices and edges"},
                     {"misses", "misses"}};
    for (const BenchGridsLeaks& l : summary.leaks)
        table.rows.push_back(
            {l.scene, l.method, static_cast<int64_t>(l.rays), static_cast<int64_t>(l.misses)});
    return table;
}

}  // namespace filigree::jobs
