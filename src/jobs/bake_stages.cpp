#include "jobs/bake_stages.h"

#include "jobs/one_stage.h"

#include <utility>

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

// Drops the micromaps the scene came with and sorts the primitives that get new ones by alpha source.
std::vector<AlphaGroup> gatherGroups(scene::Scene& scene, const BakeParameters& parameters,
                                     BakeSummary& summary) {
    std::vector<AlphaGroup> groups;
    scene.micromaps.clear();
    for (auto& mesh : scene.meshes) {
        for (auto& primitive : mesh.primitives) {
            primitive.micromaps = -1;
            primitive.micromapIndices.clear();
            summary.triangles += primitive.triangleCount();
            if (primitive.material < 0 || primitive.triangleCount() == 0) continue;
            const auto& material = scene.materials[static_cast<size_t>(primitive.material)];
            if (!isBaked(material, parameters)) continue;
            summary.maskedTriangles += primitive.triangleCount();
            addToGroup(groups, sourceToBake(material, parameters), primitive);
        }
    }
    return groups;
}

void noteSkippedMaterials(const scene::Scene& scene, const BakeParameters& parameters, BakeSummary& summary) {
    size_t opaque = 0;
    size_t blended = 0;
    for (const auto& material : scene.materials) {
        if (isBaked(material, parameters)) continue;
        (material.alphaMode == scene::AlphaMode::blend ? blended : opaque) += 1;
    }
    if (opaque > 0)
        summary.notes.push_back(fmt::format("OPAQUE materials, passed through untouched: {}", opaque));
    if (blended > 0) {
        summary.notes.push_back(fmt::format(
            "BLEND materials, passed through untouched (--include-blend bakes them): {}", blended));
    }
}

bake::Settings settingsOf(const BakeParameters& parameters) {
    bake::Settings settings;
    settings.format = parameters.states == 2 ? micromap::Format::twoState : micromap::Format::fourState;
    settings.level = parameters.level;
    settings.maxLevel = parameters.maxLevel;
    settings.rotate = parameters.rotate;
    return settings;
}

Result<BakedGroup> bakeGroup(const scene::Scene& scene, AlphaGroup group, const BakeParameters& parameters,
                             const Executor& executor, OneStage& stage) {
    std::string name = nameOf(scene, group.source);
    const image::AlphaTexture texture = textureOf(scene, group.source);
    const image::AlphaTest test = testFor(group.source, texture);
    auto baked =
        bake::bake(trianglesOf(group.primitives), texture, test, settingsOf(parameters), executor, stage);
    if (!baked) return baked.error().within(name);
    return BakedGroup{std::move(group), std::move(name), test, std::move(*baked)};
}

void noteLost(const BakedGroup& group, BakeSummary& summary) {
    const uint64_t lost = group.baked.statistics.nonFiniteTriangles;
    if (lost == 0) return;
    summary.notes.push_back(fmt::format(
        "{}: triangles whose texture coordinates are no numbers, made unknown-opaque: {}", group.name, lost));
}

}  // namespace

AlphaSource sourceToBake(const scene::Material& material, const BakeParameters& parameters) {
    AlphaSource source = sourceOf(material);
    if (source.test.mode == image::AlphaMode::mask) {
        source.test.cutoff = parameters.cutoff.value_or(source.test.cutoff);
    }
    source.test.mips = parameters.mips;
    source.test.guard = parameters.guard;
    return source;
}

bool isBaked(const scene::Material& material, const BakeParameters& parameters) {
    return material.alphaMode == scene::AlphaMode::mask ||
           (material.alphaMode == scene::AlphaMode::blend && parameters.includeBlend);
}

Result<std::vector<BakedGroup>> bakeGroups(scene::Scene& scene, const BakeParameters& parameters,
                                           const Executor& executor, ProgressSink& progress,
                                           BakeSummary& summary) {
    auto groups = gatherGroups(scene, parameters, summary);
    noteSkippedMaterials(scene, parameters, summary);
    if (parameters.mips == allMips && !groups.empty()) {
        summary.notes.push_back(
            "mips all: the coarsest level is one constant, so that few states stay known");
    }
    OneStage stage(progress, "bake", summary.maskedTriangles, "triangles");
    uint64_t finished = 0;
    std::vector<BakedGroup> bakes;
    for (AlphaGroup& group : groups) {
        for (const auto* primitive : group.primitives) finished += primitive->triangleCount();
        auto baked = bakeGroup(scene, std::move(group), parameters, executor, stage);
        if (!baked) return baked.error();
        noteLost(*baked, summary);
        bakes.push_back(std::move(*baked));
        stage.advanceTo(finished);
    }
    return bakes;
}

}  // namespace filigree::jobs
