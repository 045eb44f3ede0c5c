#include "trace/filter.h"

#include "trace/random.h"

#include <bit>

namespace filigree::trace {

// Embree's C interface knows plain structs only: the context is the first member of ours.
void filterCandidate(const RTCFilterFunctionNArguments* arguments) {
    if (arguments->valid[0] == 0) return;
    auto& context = *reinterpret_cast<RayContext*>(arguments->context);
    const Candidate candidate{static_cast<const Surface*>(arguments->geometryUserPtr),
                              RTCHitN_primID(arguments->hit, 1, 0), RTCHitN_instID(arguments->hit, 1, 0, 0),
                              RTCHitN_u(arguments->hit, 1, 0), RTCHitN_v(arguments->hit, 1, 0)};
    if (!context.accepts(context, candidate)) arguments->valid[0] = 0;
}

bool fetchAccepts(RayContext& context, const Candidate& candidate) {
    ++context.counts->textureFetches;
    const Surface& surface = *candidate.surface;
    const double alpha = surface.alphaAt(candidate.triangle, candidate.u, candidate.v);
    if (surface.kind != AlphaKind::blend) return alpha >= surface.cutoff;
    // One number for each ray and place, so that the order in which Embree asks does not matter.
    const uint32_t place = hashed(candidate.triangle, hashed(candidate.instance, surface.number));
    const uint32_t point = hashed(std::bit_cast<uint32_t>(candidate.u), std::bit_cast<uint32_t>(candidate.v));
    return alpha > unitFloat(hashed(context.seed, hashed(place, point)));
}

}  // namespace filigree::trace
