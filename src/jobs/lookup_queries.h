// The points that bench lookup asks for.
#pragma once

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

// `count` random points of random triangles that have a map, the same ones on every machine; none where no
// triangle has one. `maps` and `cautious` were baked from one scene.
LookupQueries randomQueries(const SceneMaps& maps, const SceneMaps& cautious, size_t count);

}  // namespace filigree::jobs
