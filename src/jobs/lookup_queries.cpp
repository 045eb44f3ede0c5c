#include "jobs/lookup_queries.h"

#include "filigree/trace/rays.h"

#include "jobs/busy_view.h"
#include "jobs/random.h"

#include <algorithm>
#include <cassert>
#include <unordered_map>

namespace filigree::jobs {
namespace {

struct Place {
    size_t primitive = 0;  // into SceneMaps::primitives
    size_t triangle = 0;
};

std::vector<Place> placesWithMaps(const SceneMaps& maps, const SceneMaps& cautious) {
    assert(maps.primitives.size() == cautious.primitives.size());
    std::vector<Place> places;
    for (size_t p = 0; p < maps.primitives.size(); ++p) {
        const auto& indices = maps.primitives[p].indices;
        const auto& others = cautious.primitives[p].indices;
        for (size_t t = 0; t < indices.size(); ++t) {
            if (indices[t] >= 0 && others[t] >= 0) places.push_back({p, t});
        }
    }
    return places;
}

void addPoint(LookupQueries& to, const SceneMaps& maps, const SceneMaps& cautious, Place place, float u,
              float v) {
    const MapPrimitive& primitive = maps.primitives[place.primitive];
    const mesh::UvTriangle triangle = primitive.primitive->uvTriangle(place.triangle);
    const auto& uv = triangle.uv;
    to.maps.push_back(static_cast<uint32_t>(primitive.indices[place.triangle]));
    to.cautiousMaps.push_back(
        static_cast<uint32_t>(cautious.primitives[place.primitive].indices[place.triangle]));
    to.u.push_back(u);
    to.v.push_back(v);
    to.textures.push_back(static_cast<uint32_t>(primitive.group));
    to.s.push_back(uv[0].u + u * (uv[1].u - uv[0].u) + v * (uv[2].u - uv[0].u));
    to.t.push_back(uv[0].v + u * (uv[1].v - uv[0].v) + v * (uv[2].v - uv[0].v));
    to.vertexAlpha.push_back(std::ranges::any_of(triangle.alpha, [](float alpha) { return alpha != 1; }));
}

void addRandomPoint(LookupQueries& to, const SceneMaps& maps, const SceneMaps& cautious, Place place,
                    Random& random) {
    auto u = static_cast<float>(random.uniform(0, 1));
    auto v = static_cast<float>(random.uniform(0, 1));
    if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
    }
    addPoint(to, maps, cautious, place, u, v);
}

// A tested point that has a map.
struct MappedPoint {
    Place place;
    float u = 0;
    float v = 0;
};

std::vector<MappedPoint> mappedPoints(const SceneMaps& maps, const SceneMaps& cautious,
                                      const std::vector<TestedPoint>& points) {
    std::unordered_map<const scene::Primitive*, size_t> numbers;
    for (size_t p = 0; p < maps.primitives.size(); ++p) numbers.emplace(maps.primitives[p].primitive, p);
    std::vector<MappedPoint> mapped;
    for (const TestedPoint& point : points) {
        const auto number = numbers.find(point.primitive);
        if (number == numbers.end()) continue;
        const size_t p = number->second;
        if (maps.primitives[p].indices[point.triangle] < 0 ||
            cautious.primitives[p].indices[point.triangle] < 0)
            continue;
        mapped.push_back({{p, point.triangle}, point.u, point.v});
    }
    return mapped;
}

}  // namespace

LookupQueries randomQueries(const SceneMaps& maps, const SceneMaps& cautious, size_t count) {
    LookupQueries queries;
    const std::vector<Place> places = placesWithMaps(maps, cautious);
    if (places.empty()) return queries;
    Random random(1);
    for (size_t k = 0; k < count; ++k)
        addRandomPoint(queries, maps, cautious, places[random.next() % places.size()], random);
    return queries;
}

LookupQueries hitQueries(const SceneMaps& maps, const SceneMaps& cautious,
                         const std::vector<TestedPoint>& points, size_t count) {
    LookupQueries queries;
    const auto mapped = mappedPoints(maps, cautious, points);
    for (size_t k = 0; k < count && !mapped.empty(); ++k) {
        const MappedPoint& point = mapped[k % mapped.size()];
        addPoint(queries, maps, cautious, point.place, point.u, point.v);
    }
    return queries;
}

std::vector<TestedPoint> testedPoints(const scene::Scene& scene, bool blend) {
    trace::WorldOptions building;
    building.blend = blend;
    const auto world = trace::World::build(scene, building);
    if (!world) return {};
    const auto texture = trace::Opacity::make(trace::Method::texture, 4, *world, {}, {});
    if (!texture) return {};
    trace::RenderSettings settings;
    settings.integrator = trace::Integrator::ao;
    settings.camera = busyView(scene, *world);
    auto rays = raysOf(*world, *texture, settings);
    std::erase_if(rays, [](const trace::Ray& ray) { return ray.kind != trace::RayKind::ao; });
    std::vector<TestedPoint> points;
    for (const auto& hit : candidateHits(*world, rays))
        points.push_back({&world->primitive(hit.surface), hit.triangle, hit.u, hit.v});
    return points;
}

}  // namespace filigree::jobs
