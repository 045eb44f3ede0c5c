// Embree's way into the alpha test.
#pragma once

#include "filigree/trace/counters.h"

#include "trace/world_data.h"

#include <array>
#include <cstddef>
#include <cstdint>

#include <embree3/rtcore.h>

namespace filigree::trace {

struct RayContext;

// A candidate hit: where on which triangle.
struct Candidate {
    const Surface* surface = nullptr;
    uint32_t triangle = 0;
    uint32_t instance = 0;
    float u = 0;
    float v = 0;
};

// True when the candidate is a hit.
using AcceptFunction = bool (*)(RayContext&, const Candidate&);

// Candidates set aside. Full, it takes no more, and they are tested at once.
struct DeferredCandidates {
    std::array<Candidate, 16> of;
    size_t count = 0;
    bool push(const Candidate& candidate) {
        if (count == of.size()) return false;
        of[count++] = candidate;
        return true;
    }
};

// What travels with a ray. Embree hands the first member back to the filter.
struct RayContext {
    RTCIntersectContext embree;
    AcceptFunction accepts = nullptr;
    const void* opacity = nullptr;  // what `accepts` knows it to be
    RayCounts* counts = nullptr;
    DeferredCandidates* deferred = nullptr;  // null: nothing is set aside
    uint32_t seed = 0;                       // of the ray, for stochastic transparency
    bool twoState = false;
    bool countBitsRead = false;
};

// The filter function of every surface that is tested.
void filterCandidate(const RTCFilterFunctionNArguments* arguments);

// The any-hit test: alpha from the texture against the cutoff, or a random number for BLEND.
bool fetchAccepts(RayContext& context, const Candidate& candidate);

}  // namespace filigree::trace
