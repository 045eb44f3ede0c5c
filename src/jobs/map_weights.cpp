#include "jobs/map_weights.h"

#include <utility>

namespace filigree::jobs {
namespace {

// areaOf(primitive, triangle) is what a triangle counts.
template <class AreaOf>
MapWeights weighted(const SceneMaps& maps, const AreaOf& areaOf) {
    MapWeights weights;
    weights.ofMap.assign(maps.maps.size(), 0.0);
    for (const MapPrimitive& primitive : maps.primitives) {
        const std::vector<double> areas = areaOf(primitive);
        for (size_t t = 0; t < areas.size(); ++t) {
            const int32_t index = primitive.indices[t];
            if (index >= 0) {
                weights.ofMap[static_cast<size_t>(index)] += areas[t];
            } else {
                weights.ofSpecial[static_cast<size_t>(micromap::stateOfSpecialIndex(index))] += areas[t];
            }
            weights.total += areas[t];
        }
    }
    return weights;
}

}  // namespace

double MapWeights::unknown(const micromap::QuadtreeList& maps) const {
    double sum = ofSpecial[2] + ofSpecial[3];
    for (size_t k = 0; k < maps.size(); ++k) {
        const micromap::StateCounts counts = micromap::countStates(maps[k]);
        sum += ofMap[k] * static_cast<double>(counts.total() - counts.known()) /
               static_cast<double>(counts.total());
    }
    return sum;
}

MapWeights weightsOf(const scene::Scene& scene, const SceneMaps& maps) {
    MapWeights weights = weighted(
        maps, [&](const MapPrimitive& primitive) { return scene::worldAreas(scene, *primitive.primitive); });
    if (weights.total > 0) return weights;
    return weighted(maps, [](const MapPrimitive& primitive) {
        return std::vector<double>(primitive.indices.size(), 1.0);
    });
}

void replaceMaps(SceneMaps& maps, micromap::QuadtreeList list, const std::vector<int32_t>& indices) {
    maps.maps = std::move(list);
    for (MapPrimitive& primitive : maps.primitives) {
        for (int32_t& index : primitive.indices) {
            if (index >= 0) index = indices[static_cast<size_t>(index)];
        }
    }
}

}  // namespace filigree::jobs
