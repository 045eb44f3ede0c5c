// The rays of a picture, to be cast again: what a method costs without the shading around it.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/vec3.h"
#include "filigree/trace/counters.h"
#include "filigree/trace/opacity.h"
#include "filigree/trace/render.h"
#include "filigree/trace/world.h"

#include <cstdint>
#include <span>
#include <vector>

namespace filigree::trace {

// Shadow and AO rays ask whether anything is hit, the others for the nearest hit.
struct Ray {
    Vec3 origin{};
    Vec3 direction{};
    float length = 0;   // in lengths of `direction`
    uint32_t seed = 0;  // for stochastic transparency
    RayKind kind = RayKind::primary;
};

// All rays of one sample of every pixel, tile by tile as one thread casts them. `settings` must be checked.
FILIGREE_API std::vector<Ray> raysOf(const World& world, const Opacity& opacity,
                                     const RenderSettings& settings);

// What some rays found, to compare methods by.
struct CastSummary {
    uint64_t hits = 0;
    uint64_t hash = 0;  // of which rays hit and, where nearest hits were asked for, of which triangles
};

// Casts rays one after another on this thread and counts what they cost. Bits read are counted on request,
// which takes time.
FILIGREE_API CastSummary castRays(const World& world, const Opacity& opacity, std::span<const Ray> rays,
                                  bool countBitsRead, Counters& counters);

// A candidate hit that an alpha test decides.
struct CandidateHit {
    uint32_t surface = 0;   // of the world
    uint32_t triangle = 0;  // of the surface
    float u = 0;            // weights of vertices 1 and 2
    float v = 0;
};

// All candidates that `rays` meet where the texture decides each, in the order of the tests.
FILIGREE_API std::vector<CandidateHit> candidateHits(const World& world, std::span<const Ray> rays);

}  // namespace filigree::trace
