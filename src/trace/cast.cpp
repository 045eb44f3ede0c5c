#include "trace/cast.h"

#include "trace/embree_ray.h"

#include <algorithm>
#include <cmath>

namespace filigree::trace {
namespace {

// Embree asserts that rays are finite and not far beyond the scene, also in the space of an instance.
bool isUsable(const Ray& ray) {
    const auto within = [](const Vec3& v, float limit) {
        return std::ranges::all_of(v, [&](float x) { return std::fabs(x) <= limit; });
    };
    return within(ray.origin, 10 * worldReach) && within(ray.direction, 2) && ray.length >= 0;
}

}  // namespace

RayContext Caster::contextOf(const Ray& ray) {
    RayContext context;
    rtcInitIntersectContext(&context.embree);
    if (ray.kind == RayKind::primary) context.embree.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    context.accepts = opacity_.accepts;
    context.opacity = &opacity_;
    context.counts = &counters_[ray.kind];
    context.seed = ray.seed;
    context.twoState = options_.twoStateShadows && asksForAnyHit(ray.kind);
    context.countBitsRead = options_.countBitsRead;
    ++context.counts->rays;
    return context;
}

std::optional<NearestHit> Caster::nearestHit(const Ray& ray) {
    RayContext context = contextOf(ray);
    if (!isUsable(ray)) return std::nullopt;
    RTCRayHit found;
    found.ray = embreeRay(ray.origin, ray.direction, 0, ray.length);
    found.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    found.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(world_.top.get(), &context.embree, &found);
    NearestHit hit;
    hit.distance = found.ray.tfar;
    hit.surface = found.hit;
    if (tracer_) hit.grid = tracer_->closest({ray.origin, ray.direction, 0, hit.distance});
    if (hit.onGrid()) {
        hit.distance = hit.grid.t;
    } else if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
        return std::nullopt;
    }
    return hit;
}

bool Caster::isOccluded(const Ray& ray) {
    RayContext context = contextOf(ray);
    if (!isUsable(ray)) return false;
    if (tracer_ && tracer_->any({ray.origin, ray.direction, 0, ray.length})) return true;
    DeferredCandidates deferred;
    if (options_.defer) context.deferred = &deferred;
    RTCRay found = embreeRay(ray.origin, ray.direction, 0, ray.length);
    rtcOccluded1(world_.top.get(), &context.embree, &found);
    if (found.tfar < 0) return true;
    return std::any_of(deferred.of.begin(), deferred.of.begin() + static_cast<std::ptrdiff_t>(deferred.count),
                       [&](const Candidate& candidate) { return fetchAccepts(context, candidate); });
}

}  // namespace filigree::trace
