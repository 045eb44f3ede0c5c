#include "filigree/jobs/render.h"

namespace filigree::jobs {

report::Table rayTable(const RenderSummary& s) {
    report::Table table;
    table.caption = "What rays of each kind cost";
    table.columns = {{"kind", "Rays"},       {"rays", "Count"},      {"candidates", "Candidate hits"},
                     {"lookups", "Lookups"}, {"unknown", "Unknown"}, {"fetches", "Texture fetches"},
                     {"per_ray", "per ray"}, {"bits", "Bits/lookup"}};
    const auto whole = [](uint64_t n) { return static_cast<int64_t>(n); };
    const auto share = [](uint64_t n, uint64_t of) -> report::Cell {
        if (of == 0) return {};
        return static_cast<double>(n) / static_cast<double>(of);
    };
    for (size_t k = 0; k < trace::rayKindCount; ++k) {
        const auto kind = static_cast<trace::RayKind>(k);
        const trace::RayCounts& c = s.counters[kind];
        if (c.rays == 0) continue;
        table.rows.push_back({std::string(nameOf(kind)), whole(c.rays), whole(c.candidateHits),
                              whole(c.lookups), whole(c.unknown), whole(c.textureFetches),
                              share(c.textureFetches, c.rays), share(c.bitsRead, c.lookups)});
    }
    return table;
}

}  // namespace filigree::jobs
