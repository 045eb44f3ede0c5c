#include "filigree/jobs/render.h"

#include "jobs/json_text.h"

namespace filigree::jobs {
namespace {

Json countsJson(const trace::RayCounts& counts) {
    return {{"rays", counts.rays},
            {"candidate_hits", counts.candidateHits},
            {"lookups", counts.lookups},
            {"unknown", counts.unknown},
            {"texture_fetches", counts.textureFetches},
            {"bits_read", counts.bitsRead}};
}

Json levelJson(const RenderSummary& s) {
    if (!s.hasLevels) return nullptr;
    return s.level ? Json(*s.level) : Json("auto");
}

Json gridsJson(const RenderedGrids& grids) {
    return {{"codec", grids.codec},
            {"triangles", grids.triangles},
            {"bytes", grids.bytes},
            {"bytes_per_triangle", static_cast<double>(grids.bytes) / static_cast<double>(grids.triangles)}};
}

Json deviceJson(const RenderSummary& s) {
    return {{"device", s.device},
            {"driver", s.driver},
            {"path", s.path},
            {"build", s.build.empty() ? Json(nullptr) : Json(s.build)},
            {"device_seconds", s.deviceSeconds}};
}

Json rayKindsJson(const RenderSummary& s) {
    Json kinds = Json::object();
    for (size_t k = 0; k < trace::rayKindCount; ++k) {
        const auto kind = static_cast<trace::RayKind>(k);
        if (s.counters[kind].rays > 0) kinds[std::string(nameOf(kind))] = countsJson(s.counters[kind]);
    }
    return kinds;
}

Json triptychJson(const TriptychSummary& triptych) {
    return {{"texture_fetches_without", triptych.textureFetches},
            {"identical", triptych.identical},
            {"psnr", triptych.identical ? Json(nullptr) : Json(triptych.psnr)}};
}

}  // namespace

double RenderSummary::mraysPerSecond() const {
    return seconds > 0 ? static_cast<double>(counters.total().rays) / seconds * 1e-6 : 0;
}

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

std::string toJson(const RenderSummary& s) {
    Json json{{"method", s.method},    {"states", s.states ? Json(*s.states) : Json(nullptr)},
              {"level", levelJson(s)}, {"integrator", s.integrator},
              {"width", s.width},      {"height", s.height},
              {"spp", s.spp},          {"seconds", s.seconds}};
    const trace::RayCounts total = s.counters.total();
    json["rays"] = total.rays;
    json["mrays_per_second"] = s.mraysPerSecond();
    json.update(countsJson(total));
    json["bytes"] = {{"opacity", s.opacityBytes},
                     {"textures", s.textureBytes},
                     {"geometry", s.geometryBytes},
                     {"bvh", s.bvhBytes}};
    if (s.grids) json["grids"] = gridsJson(*s.grids);
    json["image_sha256"] = s.imageSha256;
    json["backend"] = s.backend;
    if (!s.device.empty()) json.update(deviceJson(s));
    json["ray_kinds"] = rayKindsJson(s);
    if (s.triptych) json["triptych"] = triptychJson(*s.triptych);
    json["first_sample_seconds"] = s.firstSampleSeconds;
    json["total_seconds"] = s.totalSeconds;
    json["peak_bytes"] = s.peakBytes;
    return dump(json);
}

}  // namespace filigree::jobs
