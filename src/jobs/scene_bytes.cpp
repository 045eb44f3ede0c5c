#include "jobs/scene_bytes.h"

#include <algorithm>
#include <set>
#include <vector>

namespace filigree::jobs {

uint64_t textureBytes(const scene::Scene& scene, const SceneMaps& maps) {
    std::set<int> images;
    for (const MapPrimitive& p : maps.primitives)
        images.insert(scene.materials[static_cast<size_t>(p.primitive->material)].image);
    uint64_t bytes = 0;
    for (const int image : images) {
        if (image < 0) continue;
        const auto& alpha = scene.images[static_cast<size_t>(image)].alpha;
        if (alpha) bytes += uint64_t{alpha->width} * alpha->height;
    }
    return bytes;
}

uint64_t vertexBytes(const SceneMaps& maps) {
    constexpr uint64_t coordinateBytes = 8;
    uint64_t vertices = 0;
    for (const MapPrimitive& p : maps.primitives) {
        std::vector<bool> used(p.primitive->positions.size());
        for (const uint32_t vertex : p.primitive->indices) used[vertex] = true;
        vertices += static_cast<uint64_t>(std::ranges::count(used, true));
    }
    return vertices * coordinateBytes;
}

}  // namespace filigree::jobs
