#include "filigree/trace/render.h"

#include "trace/camera.h"
#include "trace/cast.h"
#include "trace/cosine_direction.h"
#include "trace/random.h"
#include "trace/srgb.h"
#include "trace/tiles.h"
#include "trace/world_data.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace filigree::trace {
namespace {

constexpr float farthest = std::numeric_limits<float>::infinity();
constexpr Vec3 plainAlbedo{0.6F, 0.6F, 0.6F};
// Those of devices, too.
#define LIGHT(name, red, green, blue) constexpr Vec3 name{red##F, green##F, blue##F};
#define LIGHT_NUMBER(name, value) constexpr float name = value##F;
#include "trace/light_values.glsl"
#undef LIGHT
#undef LIGHT_NUMBER
const Vec3 towardsSun = normalised(sunDirection);

Vec3 product(const Vec3& a, const Vec3& b) {
    return {a[0] * b[0], a[1] * b[1], a[2] * b[2]};
}
Vec3 blended(const Vec3& a, const Vec3& b, float share) {
    return plus(times(a, 1 - share), times(b, share));
}

Vec3 sky(const Vec3& direction) {
    return blended(haze, zenith, std::clamp(direction[1], 0.0F, 1.0F));
}

// A place that a ray hit, as seen from where it came.
struct Place {
    Vec3 point{};
    Vec3 normal{};  // geometric, of length 1, towards the ray's origin
    Vec3 albedo{};
};

// Of length 1 and towards where a ray comes from.
Vec3 facingNormal(const Vec3& normal, const Vec3& direction) {
    if (!(dot(normal, normal) > 0)) return times(direction, -1);
    const Vec3 unit = normalised(normal);
    return dot(unit, direction) > 0 ? times(unit, -1) : unit;
}

// A smooth normal on the side of the flat one.
Vec3 bent(const Vec3& flat, const Vec3& smooth) {
    if (!(dot(smooth, smooth) > 0)) return flat;
    const Vec3 unit = normalised(smooth);
    return dot(unit, flat) < 0 ? times(unit, -1) : unit;
}

// The nearest texel: the pictures show alpha tests, not texture filters.
Vec3 albedoOf(const Surface& surface, uint32_t triangle, float u, float v) {
    if (surface.material == nullptr) return plainAlbedo;
    const scene::Material& material = *surface.material;
    const Vec3 factor{material.baseColourFactor[0], material.baseColourFactor[1],
                      material.baseColourFactor[2]};
    if (surface.colour == nullptr) return factor;
    const scene::ColourImage& image = *surface.colour;
    const mesh::Uv uv = surface.coordinatesAt(triangle, u, v);
    const auto texel = [](float at, uint32_t size, image::Wrap wrap) {
        const float scaled = std::clamp(std::floor(at * static_cast<float>(size)), -1e9F, 1e9F);
        return image::wrapTexel(static_cast<int64_t>(scaled), size, wrap);
    };
    const uint32_t x = texel(uv.u, image.width, material.wrapU);
    const uint32_t y = texel(uv.v, image.height, material.wrapV);
    const uint8_t* rgba = &image.rgba[4 * (size_t{y} * image.width + x)];
    const auto& linear = linearOfSrgb();
    return product(factor, {linear[rgba[0]], linear[rgba[1]], linear[rgba[2]]});
}

// Follows the rays of one sample of one pixel after another.
class Walker {
  public:
    // Writes all rays down, too, where there is a list for them.
    Walker(const World& world, const Opacity& opacity, const RenderSettings& settings, unsigned sample,
           std::vector<Ray>* rays = nullptr)
        : world_(world.data()),
          caster_(world.data(), opacity.data(),
                  {settings.defer, settings.twoStateShadows, settings.countBitsRead}),
          rays_(rays),
          settings_(settings),
          sample_(sample),
          camera_(settings.camera, settings.width, settings.height),
          epsilon_(rayEpsilon(world)),
          aoDistance_(aoDistanceOf(settings, world)) {}

    Vec3 pixel(uint32_t x, uint32_t y) {
        RandomStream random(settings_.seed, y * settings_.width + x, sample_);
        // In this order, which a device keeps, too (shaders/picture.comp).
        const float down = static_cast<float>(y) + random.next();
        const float across = static_cast<float>(x) + random.next();
        const Vec3 direction = camera_.through(across, down);
        const auto place = intersect(camera_.origin(), direction, RayKind::primary, random.bits());
        if (!place) return sky(direction);
        ++pixelsHit_;
        switch (settings_.integrator) {
            case Integrator::primary:
                return times(place->albedo,
                             headlightLeast + headlightMore * std::fabs(dot(place->normal, direction)));
            case Integrator::shadow:
                return product(place->albedo, plus(shade, sunAt(*place, random)));
            case Integrator::ao:
                return times({openLight, openLight, openLight}, isOpen(*place, random) ? 1.0F : 0.0F);
            case Integrator::path:
                break;
        }
        return path(*place, random);
    }

    [[nodiscard]] const Counters& counters() const { return caster_.counters(); }
    [[nodiscard]] uint64_t pixelsHit() const { return pixelsHit_; }

  private:
    std::optional<Place> intersect(const Vec3& origin, const Vec3& direction, RayKind kind, uint32_t seed) {
        const auto hit = caster_.nearestHit(noted({origin, direction, farthest, seed, kind}));
        if (!hit) return std::nullopt;
        return hit->onGrid() ? placeOnGrid(*hit, origin, direction) : placeOf(hit->surface, direction);
    }

    const Ray& noted(const Ray& ray) {
        if (rays_ != nullptr) rays_->push_back(ray);
        return ray;
    }

    [[nodiscard]] Place placeOf(const RTCHit& hit, const Vec3& direction) const {
        const Surface& surface = world_.surfaceOf(hit);
        const auto& transform = world_.placements[hit.instID[0]].transform;
        std::array<Vec3, 3> corners;
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t vertex = surface.primitive->indices[size_t{3} * hit.primID + k];
            corners[k] = transformed(transform, surface.primitive->positions[vertex]);
        }
        const Vec3 e1 = minus(corners[1], corners[0]);
        const Vec3 e2 = minus(corners[2], corners[0]);
        return {plus(corners[0], plus(times(e1, hit.u), times(e2, hit.v))),
                facingNormal(cross(e1, e2), direction), albedoOf(surface, hit.primID, hit.u, hit.v)};
    }

    [[nodiscard]] Place placeOnGrid(const NearestHit& hit, const Vec3& origin, const Vec3& direction) const {
        const GridPart& part = world_.grids;
        Place place;
        place.point = plus(origin, times(direction, hit.distance));
        place.normal = facingNormal(hit.grid.normal, direction);
        place.albedo = part.albedo ? part.albedo(hit.grid) : gridAlbedo;
        if (part.attributes == nullptr || part.attributes->empty()) return place;
        if (const auto smooth = surfaceAt(*part.attributes, part.table, hit.grid).normal)
            place.normal = bent(place.normal, *smooth);
        return place;
    }

    // True when something lies within `length` of a place.
    bool isOccluded(const Place& place, const Vec3& direction, float length, RayKind kind,
                    RandomStream& random) {
        const Vec3 origin = plus(place.point, times(place.normal, epsilon_));
        return caster_.isOccluded(noted({origin, direction, length, random.bits(), kind}));
    }

    Vec3 sunAt(const Place& place, RandomStream& random) {
        const float facing = dot(place.normal, towardsSun);
        if (facing <= 0 || isOccluded(place, towardsSun, farthest, RayKind::shadow, random)) return {0, 0, 0};
        return times(sunlight, facing);
    }

    bool isOpen(const Place& place, RandomStream& random) {
        return !isOccluded(place, cosineDirection(place.normal, random), aoDistance_, RayKind::ao, random);
    }

    Vec3 path(Place place, RandomStream& random) {
        Vec3 light{};
        Vec3 throughput{1, 1, 1};
        for (unsigned bounce = 0;; ++bounce) {
            throughput = product(throughput, place.albedo);
            light = plus(light, product(throughput, sunAt(place, random)));
            if (bounce == settings_.bounces) return light;
            const Vec3 direction = cosineDirection(place.normal, random);
            const Vec3 origin = plus(place.point, times(place.normal, epsilon_));
            const auto next = intersect(origin, direction, RayKind::bounce, random.bits());
            if (!next) return plus(light, product(throughput, sky(direction)));
            place = *next;
        }
    }

    const World::Data& world_;
    Caster caster_;
    std::vector<Ray>* rays_;
    const RenderSettings& settings_;
    unsigned sample_;
    CameraRays camera_;
    float epsilon_;     // world units, how far rays start off a surface
    float aoDistance_;  // world units
    uint64_t pixelsHit_ = 0;
};

struct TileResult {
    Counters counters;
    uint64_t pixels = 0;
    uint64_t pixelsHit = 0;
};

// Renders one tile into the film.
TileResult renderTile(const World& world, const Opacity& opacity, const RenderSettings& settings, size_t tile,
                      Film& film) {
    Walker walker(world, opacity, settings, film.samples);
    uint64_t pixels = 0;
    forTile(film.width, film.height, tile, [&](uint32_t x, uint32_t y) {
        ++pixels;
        const RayCounts before = walker.counters().total();
        const Vec3 light = walker.pixel(x, y);
        const RayCounts after = walker.counters().total();
        const size_t at = size_t{y} * film.width + x;
        film.sums[at] = plus(film.sums[at], light);
        film.alphaTests[at] += static_cast<uint32_t>(after.textureFetches - before.textureFetches);
        film.bitsRead[at] += static_cast<uint32_t>(after.bitsRead - before.bitsRead);
    });
    return {walker.counters(), pixels, walker.pixelsHit()};
}

}  // namespace

float rayEpsilon(const World& world) {
    return std::max(1e-6F, 2e-5F * world.bounds().diagonal());
}

float aoDistanceOf(const RenderSettings& settings, const World& world) {
    return settings.aoDistance > 0 ? settings.aoDistance : 0.1F * world.bounds().diagonal();
}

bool addSample(const World& world, const Opacity& opacity, const RenderSettings& settings,
               const Executor& executor, ProgressSink& progress, Film& film) {
    std::vector<TileResult> tiles(tileCount(film.width, film.height));
    executor.parallelFor(tiles.size(), 1, [&](size_t begin, size_t end) {
        for (size_t k = begin; k < end && !progress.cancelled(); ++k) {
            tiles[k] = renderTile(world, opacity, settings, k, film);
            progress.advance(tiles[k].pixels);
        }
    });
    for (const TileResult& tile : tiles) {
        film.counters.add(tile.counters);
        film.pixelsHit += tile.pixelsHit;
    }
    ++film.samples;
    return !progress.cancelled();
}

std::vector<Ray> raysOf(const World& world, const Opacity& opacity, const RenderSettings& settings) {
    std::vector<Ray> rays;
    Walker walker(world, opacity, settings, 0, &rays);
    for (size_t k = 0; k < tileCount(settings.width, settings.height); ++k)
        forTile(settings.width, settings.height, k, [&](uint32_t x, uint32_t y) { walker.pixel(x, y); });
    return rays;
}

}  // namespace filigree::trace
