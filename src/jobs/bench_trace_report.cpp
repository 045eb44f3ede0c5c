#include "filigree/jobs/bench_trace.h"

#include "jobs/json_text.h"

namespace filigree::jobs {

std::string toJson(const BenchTraceSummary& summary) {
    const auto orNull = [](const std::optional<unsigned>& value) { return value ? Json(*value) : Json(); };
    Json rows = Json::array();
    for (const BenchTraceRow& r : summary.rows) {
        rows.push_back({{"scene", r.scene},
                        {"rays", r.rays},
                        {"method", r.method},
                        {"states", orNull(r.states)},
                        {"level", orNull(r.level)},
                        {"mrays_per_second", r.mraysPerSecond},
                        {"ratio_to_texture", r.ratioToTexture},
                        {"fetches_per_ray", r.fetchesPerRay},
                        {"tests_per_ray", r.testsPerRay},
                        {"opacity_bytes", r.opacityBytes}});
    }
    return dump({{"rows", rows}});
}

report::Table benchTraceTable(const BenchTraceSummary& summary) {
    using report::Show;
    report::Table table;
    table.caption = "Rays on one thread; ratios of speeds, above 1 is faster";
    table.columns = {{"scene", "scene"},
                     {"rays", "rays"},
                     {"method", "method"},
                     {"states", "states"},
                     {"level", "level"},
                     {"mrays", "speed", "Mrays/s", Show::plain, 3},
                     {"ratio", "to texture", "", Show::plain, 3},
                     {"least", "least", "", Show::plain, 3},
                     {"most", "most", "", Show::plain, 3},
                     {"tests", "tests a ray", "", Show::plain, 3},
                     {"fetches", "fetches a ray", "", Show::plain, 3},
                     {"bits", "bits a lookup", "", Show::plain, 1},
                     {"bytes", "opacity", "bytes", Show::bytes}};
    const auto cell = [](const std::optional<unsigned>& value) {
        return value ? report::Cell(int64_t{*value}) : report::Cell();
    };
    for (const BenchTraceRow& r : summary.rows) {
        table.rows.push_back({r.scene, r.rays, r.method, cell(r.states), cell(r.level), r.mraysPerSecond,
                              r.ratioToTexture, r.leastRatio, r.mostRatio, r.testsPerRay, r.fetchesPerRay,
                              r.bitsPerLookup, static_cast<int64_t>(r.opacityBytes)});
    }
    return table;
}

}  // namespace filigree::jobs
