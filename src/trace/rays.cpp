#include "filigree/trace/rays.h"

#include "trace/cast.h"

namespace filigree::trace {
namespace {

uint64_t mixed(uint64_t hash, uint64_t value) {
    return (hash ^ value) * 0x9e3779b97f4a7c15u + (hash >> 29);
}

// Of what was hit.
uint64_t hashOf(const NearestHit& hit) {
    if (!hit.onGrid()) return mixed(hit.surface.instID[0], mixed(hit.surface.geomID, hit.surface.primID));
    return mixed(hit.grid.grid, mixed(hit.grid.row, uint64_t{2} * hit.grid.column + hit.grid.half));
}

// The texture's answers, written down with what was asked.
struct Recording final : Opacity::Data {
    mutable std::vector<CandidateHit> candidates;
};

bool recordAndTest(RayContext& context, const Candidate& candidate) {
    static_cast<const Recording*>(context.opacity)
        ->candidates.push_back({candidate.surface->number, candidate.triangle, candidate.u, candidate.v});
    return fetchAccepts(context, candidate);
}

CastSummary castAll(Caster& caster, std::span<const Ray> rays) {
    CastSummary summary;
    for (const Ray& ray : rays) {
        uint64_t found = 0;
        if (asksForAnyHit(ray.kind)) {
            found = caster.isOccluded(ray) ? 1 : 0;
        } else if (const auto hit = caster.nearestHit(ray)) {
            found = 1 + hashOf(*hit);
        }
        summary.hits += found != 0 ? 1 : 0;
        summary.hash = mixed(summary.hash, found);
    }
    return summary;
}

}  // namespace

CastSummary castRays(const World& world, const Opacity& opacity, std::span<const Ray> rays,
                     bool countBitsRead, Counters& counters) {
    CastOptions options;
    options.countBitsRead = countBitsRead;
    Caster caster(world.data(), opacity.data(), options);
    const CastSummary summary = castAll(caster, rays);
    counters.add(caster.counters());
    return summary;
}

std::vector<CandidateHit> candidateHits(const World& world, std::span<const Ray> rays) {
    Recording recording;
    recording.accepts = recordAndTest;
    Caster caster(world.data(), recording, {});
    castAll(caster, rays);
    return std::move(recording.candidates);
}

}  // namespace filigree::trace
