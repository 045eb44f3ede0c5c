#include "jobs/deep.h"

#include "filigree/verify/verify.h"

#include "jobs/alpha_source.h"
#include "jobs/one_stage.h"

#include <algorithm>

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

// The primitives that share one micromap and one alpha source.
struct DeepGroup {
    int micromaps = -1;
    ConstAlphaGroup alpha;
};

// The source that the micromaps claim to hold: the material's own alpha, under the recorded parameters if
// any.
AlphaSource claimedSource(const scene::Material& material, const scene::Micromaps& micromaps) {
    AlphaSource source = sourceOf(material);
    if (micromaps.bakedWith) {
        const double factor = source.test.factor;
        source.test = *micromaps.bakedWith;
        source.test.factor = factor;
    }
    return source;
}

void noteParameters(const scene::Scene& scene, ValidateSummary& summary) {
    for (const auto& micromaps : scene.micromaps) {
        if (micromaps.bakedWith) continue;
        summary.notes.push_back(
            micromaps.name +
            ": records no parameters; examined with each material's own cutoff, guard 0, mips 0");
    }
}

// Sorts the primitives with micromaps by what they are examined against.
std::vector<DeepGroup> gatherGroups(const scene::Scene& scene, ValidateSummary& summary) {
    std::vector<DeepGroup> groups;
    for (const auto& mesh : scene.meshes) {
        for (const auto& primitive : mesh.primitives) {
            if (primitive.micromaps < 0) continue;
            if (primitive.material < 0 ||
                scene.materials[static_cast<size_t>(primitive.material)].alphaMode ==
                    scene::AlphaMode::opaque) {
                summary.notes.push_back(
                    fmt::format("/meshes/{}/primitives/{}: has micromaps but its material is "
                                "OPAQUE; not examined",
                                primitive.meshIndex, primitive.primitiveIndex));
                continue;
            }
            const auto source = claimedSource(scene.materials[static_cast<size_t>(primitive.material)],
                                              scene.micromaps[static_cast<size_t>(primitive.micromaps)]);
            auto group = std::find_if(groups.begin(), groups.end(), [&](const DeepGroup& g) {
                return g.micromaps == primitive.micromaps && g.alpha.source == source;
            });
            if (group == groups.end()) group = groups.insert(group, {primitive.micromaps, {source, {}}});
            group->alpha.primitives.push_back(&primitive);
        }
    }
    return groups;
}

std::string describe(const verify::Finding& finding, uint64_t triangle) {
    static constexpr const char* states[] = {"transparent", "opaque", "unknown-transparent",
                                             "unknown-opaque"};
    static constexpr const char* truths[] = {"transparent", "opaque", "mixed", "uncertain"};
    return fmt::format("triangle {}, level {}, micro-triangle {}: says {}, is {}", triangle, finding.level,
                       finding.microTriangle, states[static_cast<size_t>(finding.state)],
                       truths[static_cast<size_t>(finding.truth)]);
}

using Places = std::vector<TrianglePlace>;

uint64_t microTriangles(const Places& places, const micromap::FlatSet& set) {
    uint64_t count = 0;
    for (const auto& place : places) {
        const int32_t index = place.micromapIndex();
        count += index < 0 ? 1 : micromap::microTriangleCount(set.records[static_cast<size_t>(index)].level);
    }
    return count;
}

void addFindings(const Places& places, const std::vector<verify::Finding>& findings,
                 ValidateSummary& summary) {
    for (const auto& finding : findings) {
        const auto& [primitive, triangle, equals] = places[finding.triangle];
        summary.breaches.push_back(
            {fmt::format("/meshes/{}/primitives/{}", primitive->meshIndex, primitive->primitiveIndex),
             "a known state is true throughout", describe(finding, triangle)});
    }
}

// By which rule the special indices of a set are judged: they come from the same bake as its records.
micromap::Format specialFormat(const micromap::FlatSet& set) {
    const bool twoState = std::ranges::all_of(set.records, [](const micromap::Record& record) {
        return record.format == micromap::Format::twoState;
    });
    return twoState ? micromap::Format::twoState : micromap::Format::fourState;
}

Status examine(scene::Scene& scene, const DeepGroup& group, const Places& places, double sample,
               const Executor& executor, ProgressSink& progress, ValidateSummary& summary) {
    auto& set = scene.micromaps[static_cast<size_t>(group.micromaps)].set;
    const auto texture = textureOf(scene, group.alpha.source);
    const auto test = testFor(group.alpha.source, texture);
    std::vector<mesh::UvTriangle> triangles;
    for (const auto& place : places) {
        triangles.push_back(place.uvTriangle());
        set.indices.push_back(place.micromapIndex());
    }
    const verify::DeepSettings settings{sample, 1, specialFormat(set)};
    const auto counts = verify::deepCheck(triangles, set, texture, test, settings, executor, progress);
    set.indices.clear();
    if (!counts) return counts.error().within(nameOf(scene, group.alpha.source));
    summary.deep->microTriangles += counts->microTriangles;
    summary.deep->wrong += counts->wrong;
    summary.deep->overCautious += counts->overCautious;
    summary.deep->uncertain += counts->uncertain;
    addFindings(places, counts->first, summary);
    return {};
}

}  // namespace

Status validateDeep(scene::Scene& scene, double sample, const Executor& executor, ProgressSink& progress,
                    ValidateSummary& summary) {
    summary.deep.emplace();
    noteParameters(scene, summary);
    const auto groups = gatherGroups(scene, summary);
    std::vector<Places> work;
    uint64_t total = 0;
    for (const auto& group : groups) {
        work.push_back(distinctTriangles(group.alpha.primitives));
        total += microTriangles(work.back(), scene.micromaps[static_cast<size_t>(group.micromaps)].set);
    }
    OneStage stage(progress, "examine", total, "micro-triangles");
    for (size_t g = 0; g < groups.size(); ++g) {
        auto examined = examine(scene, groups[g], work[g], sample, executor, stage, summary);
        if (!examined) return examined;
    }
    return {};
}

}  // namespace filigree::jobs
