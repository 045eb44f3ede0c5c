#include "filigree/trace/grid_rays.h"

#include "trace/camera.h"
#include "trace/cosine_direction.h"
#include "trace/random.h"
#include "trace/tiles.h"

#include <cmath>
#include <utility>

namespace filigree::trace {
namespace {

// As is sensible for terrains and torus alike.
constexpr float overviewElevation = 0.9F;  // radians
constexpr float overviewAngle = 1.5F;      // from x towards z

std::vector<grid::Ray> pixelRays(const scene::Camera& camera, const GridRayOptions& options) {
    const CameraRays through(camera, options.width, options.height);
    std::vector<grid::Ray> rays;
    rays.reserve(size_t{options.width} * options.height);
    for (size_t tile = 0; tile < tileCount(options.width, options.height); ++tile) {
        forTile(options.width, options.height, tile, [&](uint32_t x, uint32_t y) {
            rays.push_back({through.origin(),
                            through.through(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F)});
        });
    }
    return rays;
}

// Fisher and Yates.
std::vector<grid::Ray> shuffledRays(std::vector<grid::Ray> rays, uint32_t seed) {
    for (size_t k = rays.size(); k > 1; --k) {
        const uint64_t place = (uint64_t{hashed(seed, static_cast<uint32_t>(k))} * k) >> 32;
        std::swap(rays[k - 1], rays[place]);
    }
    return rays;
}

}  // namespace

scene::Camera overviewOf(const Box& box, float aspect) {
    const float level = std::cos(overviewElevation);
    return cameraOutside(
        box, {level * std::cos(overviewAngle), std::sin(overviewElevation), level * std::sin(overviewAngle)},
        aspect);
}

GridRaySets gridRaySets(const EmbreeGrids& reference, const Box& bounds, const scene::Camera& camera,
                        const GridRayOptions& options) {
    GridRaySets sets;
    sets.primary = pixelRays(camera, options);
    std::vector<EmbreeHit> hits(sets.primary.size());
    reference.closest(sets.primary, hits);
    const float off = options.offShare * bounds.diagonal();
    for (size_t k = 0; k < hits.size(); ++k) {
        if (!std::isfinite(hits[k].t) || !(dot(hits[k].normal, hits[k].normal) > 0)) continue;
        const grid::Ray& ray = sets.primary[k];
        RandomStream random(options.seed, static_cast<uint32_t>(k), 0);
        Vec3 normal = normalised(hits[k].normal);
        if (dot(normal, ray.direction) > 0) normal = times(normal, -1);
        grid::Ray next;
        next.origin = plus(plus(ray.origin, times(ray.direction, hits[k].t)), times(normal, off));
        next.direction = cosineDirection(normal, random);
        sets.bounce.push_back(next);
        next.tMax = options.aoShare * bounds.diagonal();
        sets.ao.push_back(next);
    }
    sets.shuffled = shuffledRays(sets.bounce, options.seed);
    return sets;
}

}  // namespace filigree::trace
