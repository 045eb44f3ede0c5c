// How much of the world each micromap covers.
#pragma once

#include "filigree/scene/scene.h"

#include "jobs/scene_maps.h"

#include <array>
#include <vector>

namespace filigree::jobs {

struct MapWeights {
    std::vector<double> ofMap;  // [map_count], world area of the triangles that use it, over all instances
    std::array<double, 4> ofSpecial{};  // likewise, of triangles with a special index, by micromap::State
    double total = 0;

    // Area of unknown micro-triangles.
    [[nodiscard]] double unknown(const micromap::QuadtreeList& maps) const;
};

// `maps` look into `scene`. Where nothing has an area (no instance, say) each triangle counts 1.
MapWeights weightsOf(const scene::Scene& scene, const SceneMaps& maps);

// Replaces the maps: map k becomes `indices[k]`, a place in `list` or special.
void replaceMaps(SceneMaps& maps, micromap::QuadtreeList list, const std::vector<int32_t>& indices);

}  // namespace filigree::jobs
