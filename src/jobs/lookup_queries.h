// The points that bench lookup asks for.
#pragma once

#include "filigree/scene/scene.h"

#include "jobs/scene_maps.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace filigree::jobs {

// Element k of each is point k.
struct LookupQueries {
    std::vector<uint32_t> maps;
    std::vector<uint32_t> cautiousMaps;  // of the 4-state bake that 1-bit gruen masks come from
    std::vector<float> u, v;             // barycentrics
    std::vector<uint32_t> textures;      // into SceneMaps::groups
    std::vector<float> s, t;             // texture coordinates
    std::vector<bool> vertexAlpha;       // the triangle has an alpha that its texture does not know

    [[nodiscard]] size_t size() const { return maps.size(); }
};

// A point of a triangle that an alpha test was asked about.
struct TestedPoint {
    const scene::Primitive* primitive = nullptr;
    uint32_t triangle = 0;
    float u = 0;
    float v = 0;
};

// Where ambient-occlusion rays meet surfaces with holes, in the order of the tests, as seen from a place with
// many (busyView). The same on every machine; none where there are no such surfaces. `blend`: BLEND materials
// have holes, too.
std::vector<TestedPoint> testedPoints(const scene::Scene& scene, bool blend);

// `count` random points of random triangles that have a map, the same ones on every machine; none where no
// triangle has one. `maps` and `cautious` were baked from one scene.
LookupQueries randomQueries(const SceneMaps& maps, const SceneMaps& cautious, size_t count);

// The first `count` of `points` that have a map, from the first again when they run out; none where no point
// has one.
LookupQueries hitQueries(const SceneMaps& maps, const SceneMaps& cautious,
                         const std::vector<TestedPoint>& points, size_t count);

}  // namespace filigree::jobs
