#include "filigree/bake/bake.h"
#include "filigree/jobs/bake.h"

#include "jobs/alpha_source.h"
#include "jobs/one_stage.h"
#include "jobs/stopwatch.h"

#include <algorithm>

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

constexpr double maxGuard = 1024;  // texels; what bake::bake takes

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

// A micromap list may not be empty (formats of glTF and Vulkan), even where every index is special.
void ensureOneRecord(micromap::FlatSet& set, micromap::Format format) {
    if (!set.records.empty()) return;
    set.records.push_back({0, 0, format});
    const auto bits = (1U << micromap::bitsPerState(format)) - 1;
    set.data.push_back(static_cast<uint8_t>(static_cast<unsigned>(micromap::State::unknownOpaque) & bits));
}

// Gives each primitive its part of the group's indices, and turns its triangles where the baker did.
void handOut(const std::vector<scene::Primitive*>& primitives, int micromaps, const bake::Baked& baked,
             const std::vector<int32_t>& indices) {
    size_t first = 0;
    for (auto* primitive : primitives) {
        const size_t count = primitive->triangleCount();
        primitive->micromaps = micromaps;
        const auto begin = indices.begin() + static_cast<std::ptrdiff_t>(first);
        primitive->micromapIndices.assign(begin, begin + static_cast<std::ptrdiff_t>(count));
        for (size_t t = 0; t < count && !baked.rotations.empty(); ++t) {
            const auto corners = primitive->indices.begin() + static_cast<std::ptrdiff_t>(3 * t);
            std::rotate(corners, corners + baked.rotations[first + t], corners + 3);
        }
        first += count;
    }
}

void count(const micromap::FlatSet& set, const bake::Statistics& statistics, BakeSummary& summary) {
    summary.micromaps += set.records.size();
    for (const auto& record : set.records) ++summary.levels[record.level];
    for (const int32_t index : set.indices) {
        if (!micromap::isSpecialIndex(index)) continue;
        ++summary.special[static_cast<size_t>(micromap::stateOfSpecialIndex(index))];
    }
    summary.dataBytes += set.data.size();
    summary.recordBytes += set.records.size() * micromap::recordBytes;
    summary.microTriangles += statistics.microTriangles;
    summary.knownMicroTriangles += statistics.states.known();
}

bake::Settings settingsOf(const BakeParameters& parameters) {
    bake::Settings settings;
    settings.format = parameters.states == 2 ? micromap::Format::twoState : micromap::Format::fourState;
    settings.level = parameters.level;
    settings.maxLevel = parameters.maxLevel;
    settings.rotate = parameters.rotate;
    return settings;
}

// Bytes that a primitive's indices take in the smallest type that the formats allow: an n-bit one holds
// records below 2^n - 4.
uint64_t indexBytes(const std::vector<int32_t>& indices) {
    const int32_t highest = *std::max_element(indices.begin(), indices.end());
    return indices.size() * (highest < 0xFF - 3 ? 1 : highest < 0xFFFF - 3 ? 2 : 4);
}

Status bakeGroup(scene::Scene& scene, const AlphaGroup& group, const BakeParameters& parameters,
                 const Executor& executor, OneStage& stage, BakeSummary& summary) {
    const std::string name = nameOf(scene, group.source);
    const image::AlphaTexture texture = textureOf(scene, group.source);
    const image::AlphaTest test = testFor(group.source, texture);
    const bake::Settings settings = settingsOf(parameters);
    const auto triangles = trianglesOf(group.primitives);
    auto baked = bake::bake(triangles, texture, test, settings, executor, stage);
    if (!baked) return baked.error().within(name);
    auto flat = micromap::flatten(baked->set, executor);
    if (!flat) return flat.error().within(name + ": choose a lower level");
    ensureOneRecord(*flat, settings.format);
    count(*flat, baked->statistics, summary);
    if (const uint64_t lost = baked->statistics.nonFiniteTriangles; lost > 0) {
        summary.notes.push_back(fmt::format(
            "{}: triangles whose texture coordinates are no numbers, made unknown-opaque: {}", name, lost));
    }
    handOut(group.primitives, static_cast<int>(scene.micromaps.size()), *baked, flat->indices);
    for (const auto* primitive : group.primitives)
        summary.indexBytes += indexBytes(primitive->micromapIndices);
    flat->indices.clear();
    scene.micromaps.push_back({std::move(*flat), test, name});
    return {};
}

}  // namespace

Status check(const BakeParameters& p) {
    const auto usage = [](std::string message) { return Error{ErrorKind::usage, std::move(message)}; };
    if (p.states != 2 && p.states != 4) return usage(fmt::format("--states {}: choose 2 or 4", p.states));
    if (p.level.value_or(0) > micromap::maxLevel) {
        return usage(fmt::format("--level {}: the highest is {}", *p.level, micromap::maxLevel));
    }
    if (p.maxLevel > micromap::maxLevel) {
        return usage(fmt::format("--max-level {}: the highest is {}", p.maxLevel, micromap::maxLevel));
    }
    if (!(p.guard >= 0 && p.guard <= maxGuard)) {
        return usage(fmt::format("--guard {}: give texels from 0 to {}", p.guard, maxGuard));
    }
    if (p.cutoff && !(*p.cutoff >= 0 && *p.cutoff <= 1)) {
        return usage(fmt::format("--cutoff {}: give a number from 0 to 1", *p.cutoff));
    }
    if (p.budget) return usage("--budget: not in this version");
    return {};
}

Result<BakeSummary> bakeScene(scene::Scene& scene, const BakeParameters& parameters, const Executor& executor,
                              ProgressSink& progress) {
    if (auto checked = check(parameters); !checked) return checked.error();
    const Stopwatch watch;
    BakeSummary summary;
    const auto groups = gatherGroups(scene, parameters, summary);
    noteSkippedMaterials(scene, parameters, summary);
    if (parameters.mips == allMips && !groups.empty()) {
        summary.notes.push_back(
            "mips all: the coarsest level is one constant, so that few states stay known");
    }
    OneStage stage(progress, "bake", summary.maskedTriangles, "triangles");
    uint64_t finished = 0;
    for (const auto& group : groups) {
        if (auto baked = bakeGroup(scene, group, parameters, executor, stage, summary); !baked) {
            return baked.error();
        }
        for (const auto* primitive : group.primitives) finished += primitive->triangleCount();
        stage.advanceTo(finished);
    }
    summary.bakeSeconds = watch.seconds();
    return summary;
}

}  // namespace filigree::jobs
