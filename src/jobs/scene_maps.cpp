#include "jobs/scene_maps.h"

#include "filigree/micromap/distinct_trees.h"

#include "jobs/bake_stages.h"

#include <algorithm>
#include <cassert>
#include <span>
#include <utility>

namespace filigree::jobs {
namespace {

// Where a map of one group stands in the list of the scene, once it has been asked for.
class Renumbering {
  public:
    explicit Renumbering(size_t maps) : places_(maps) {}

    // `add(map)` adds the group's map to the list and gives its place there.
    template <class Add>
    int32_t place(int32_t index, Add&& add) {
        if (index < 0) return index;
        std::optional<int32_t>& place = places_[static_cast<size_t>(index)];
        if (!place) place = add(static_cast<size_t>(index));
        return *place;
    }

  private:
    std::vector<std::optional<int32_t>> places_;
};

// Adds a baked group and its maps.
void addGroup(const BakedGroup& group, micromap::DistinctTrees& distinct, SceneMaps& to) {
    const micromap::TreeSet& set = group.baked.set;
    Renumbering renumbering(set.trees.size());
    const auto add = [&](size_t map) { return distinct.add(set.trees[map]); };
    size_t next = 0;
    for (const scene::Primitive* primitive : group.alpha.primitives) {
        auto& out = to.primitives.emplace_back();
        out.primitive = primitive;
        out.group = to.groups.size();
        out.indices.resize(primitive->triangleCount());
        for (int32_t& index : out.indices) index = renumbering.place(set.indices[next++], add);
    }
    to.groups.push_back({group.name, group.test, group.alpha.source});
}

void toSceneOrder(std::vector<MapPrimitive>& primitives) {
    std::ranges::sort(primitives, [](const MapPrimitive& a, const MapPrimitive& b) {
        return std::pair(a.primitive->meshIndex, a.primitive->primitiveIndex) <
               std::pair(b.primitive->meshIndex, b.primitive->primitiveIndex);
    });
}

// The level that all maps have, if they have one.
std::optional<unsigned> commonLevel(const micromap::QuadtreeList& maps) {
    if (maps.size() == 0) return std::nullopt;
    for (size_t k = 1; k < maps.size(); ++k) {
        if (maps[k].level != maps[0].level) return std::nullopt;
    }
    return maps[0].level;
}

micromap::Quadtree treeOf(const micromap::FlatSet& set, size_t map) {
    const micromap::Record& record = set.records[map];
    const auto flat =
        std::span(set.data).subspan(record.byteOffset, micromap::flatBytes(record.level, record.format));
    return micromap::quadtreeFromFlat(flat, record.level, record.format);
}

micromap::Format commonFormat(const scene::Scene& scene) {
    for (const auto& micromaps : scene.micromaps) {
        for (const auto& record : micromaps.set.records) {
            if (record.format == micromap::Format::fourState) return micromap::Format::fourState;
        }
    }
    return micromap::Format::twoState;
}

}  // namespace

std::vector<micromap::QuadtreeView> SceneMaps::views() const {
    std::vector<micromap::QuadtreeView> views;
    views.reserve(maps.size());
    for (size_t k = 0; k < maps.size(); ++k) views.push_back(maps[k]);
    return views;
}

Result<SceneMaps> bakeMaps(scene::Scene& scene, const BakeParameters& parameters, const Executor& executor,
                           ProgressSink& progress) {
    assert(!parameters.budget && !parameters.rotate);
    if (auto checked = check(parameters); !checked) return checked.error();
    BakeSummary summary;
    auto groups = bakeGroups(scene, parameters, executor, progress, summary);
    if (!groups) return groups.error();
    SceneMaps result;
    result.format = parameters.states == 2 ? micromap::Format::twoState : micromap::Format::fourState;
    micromap::DistinctTrees distinct;
    for (BakedGroup& group : *groups) {
        addGroup(group, distinct, result);
        group.baked = {};  // so that no map is held twice for long
    }
    result.maps = std::move(distinct).take();
    result.level = parameters.level ? parameters.level : commonLevel(result.maps);
    toSceneOrder(result.primitives);
    result.triangles = summary.triangles;
    result.maskedTriangles = summary.maskedTriangles;
    result.notes = std::move(summary.notes);
    return result;
}

SceneMaps carriedMaps(const scene::Scene& scene) {
    SceneMaps result;
    result.format = commonFormat(scene);
    micromap::DistinctTrees distinct;
    std::vector<Renumbering> renumberings;
    for (const auto& micromaps : scene.micromaps) {
        renumberings.emplace_back(micromaps.set.records.size());
        result.groups.push_back({micromaps.name, micromaps.bakedWith, std::nullopt});
    }
    for (const auto& mesh : scene.meshes) {
        for (const auto& primitive : mesh.primitives) {
            result.triangles += primitive.triangleCount();
            if (primitive.micromaps < 0) continue;
            result.maskedTriangles += primitive.triangleCount();
            auto& out = result.primitives.emplace_back();
            out.primitive = &primitive;
            out.group = static_cast<size_t>(primitive.micromaps);
            const micromap::FlatSet& set = scene.micromaps[out.group].set;
            const auto add = [&](size_t map) { return distinct.add(treeOf(set, map).view()); };
            for (const int32_t index : primitive.micromapIndices)
                out.indices.push_back(renumberings[out.group].place(index, add));
        }
    }
    result.maps = std::move(distinct).take();
    result.level = commonLevel(result.maps);
    return result;
}

}  // namespace filigree::jobs
