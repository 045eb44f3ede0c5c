// One ray into a world.
#pragma once

#include "filigree/grid/rays.h"
#include "filigree/trace/rays.h"

#include "trace/filter.h"
#include "trace/opacity_data.h"
#include "trace/world_data.h"

#include <optional>

#include <embree3/rtcore.h>

namespace filigree::trace {

// What all rays of a picture have in common.
struct CastOptions {
    bool defer = false;            // as RenderSettings::defer
    bool twoStateShadows = false;  // as RenderSettings::twoStateShadows
    bool countBitsRead = false;
};

// A hit on a surface under Embree or on a grid.
struct NearestHit {
    float distance = 0;  // in lengths of the ray's direction
    RTCHit surface;      // where onGrid() is false
    grid::Hit grid;      // where it is true

    [[nodiscard]] bool onGrid() const { return grid.grid != grid::noGrid; }
};

// Casts rays and counts what they cost.
class Caster {
  public:
    // The first two must outlive it.
    Caster(const World::Data& world, const Opacity::Data& opacity, const CastOptions& options)
        : world_(world), opacity_(opacity), options_(options) {
        if (world.grids.grids != nullptr) tracer_.emplace(*world.grids.grids);
    }

    std::optional<NearestHit> nearestHit(const Ray& ray);
    bool isOccluded(const Ray& ray);

    [[nodiscard]] const Counters& counters() const { return counters_; }

  private:
    RayContext contextOf(const Ray& ray);

    const World::Data& world_;
    const Opacity::Data& opacity_;
    CastOptions options_;
    std::optional<grid::Tracer> tracer_;  // where the world has grids
    Counters counters_;
};

// True where only whether something is hit matters.
constexpr bool asksForAnyHit(RayKind kind) {
    return kind == RayKind::shadow || kind == RayKind::ao;
}

}  // namespace filigree::trace
