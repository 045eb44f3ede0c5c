#include "filigree/bake/budget.h"
#include "filigree/jobs/bake.h"

#include "jobs/bake_stages.h"
#include "jobs/stopwatch.h"

#include <algorithm>

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

constexpr double maxGuard = 1024;  // texels; what bake::bake takes

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

// World area of the triangles that use each micromap of a group, by micromap; what is left is that of unknown
// ones.
std::vector<double> weightsOf(const scene::Scene& scene, const BakedGroup& group, double& unknownWeight) {
    const auto& indices = group.baked.set.indices;
    std::vector<double> weights(group.baked.set.trees.size(), 0.0);
    size_t t = 0;
    for (const auto* primitive : group.alpha.primitives) {
        for (const double area : scene::worldAreas(scene, *primitive)) {
            const int32_t index = indices[t++];
            if (index >= 0) {
                weights[static_cast<size_t>(index)] += area;
            } else if (!micromap::isKnown(micromap::stateOfSpecialIndex(index))) {
                unknownWeight += area;
            }
        }
    }
    return weights;
}

// Coarsens the micromaps of all groups until they fit the budget.
void fitBudget(const scene::Scene& scene, uint64_t budget, std::vector<BakedGroup>& groups,
               BakeSummary& summary) {
    std::vector<bake::BudgetMap> maps;
    double unknownWeight = 0;
    for (const BakedGroup& group : groups) {
        const std::vector<double> weights = weightsOf(scene, group, unknownWeight);
        for (size_t k = 0; k < weights.size(); ++k) maps.push_back({group.baked.set.trees[k], weights[k]});
    }
    // Each group needs one record, even where nothing is left for it.
    const uint64_t reserved = groups.size() * (micromap::recordBytes + 1);
    const uint64_t left = budget > reserved ? budget - reserved : 0;
    const auto format = groups.empty() ? micromap::Format::fourState : groups.front().baked.set.format;
    const bake::BudgetChoice choice = bake::chooseLevels(maps, format, left);
    summary.budgetCost = choice.cost + unknownWeight;
    summary.budgetBound = choice.bound + unknownWeight;
    size_t first = 0;
    for (BakedGroup& group : groups) {
        const size_t count = group.baked.set.trees.size();
        group.baked.set = bake::coarsenedTo(group.baked.set, std::span(choice.levels).subspan(first, count));
        first += count;
    }
}

// States of all triangles after the budget changed them.
micromap::StateCounts countStates(const micromap::TreeSet& set) {
    std::vector<micromap::StateCounts> ofTree(set.trees.size());
    for (size_t k = 0; k < ofTree.size(); ++k) ofTree[k] = micromap::countStates(set.trees[k]);
    micromap::StateCounts sum;
    for (const int32_t index : set.indices) {
        if (index < 0) {
            ++sum.of[static_cast<size_t>(micromap::stateOfSpecialIndex(index))];
            continue;
        }
        sum.add(ofTree[static_cast<size_t>(index)]);
    }
    return sum;
}

// Flattens a group's micromaps into the scene and counts them.
Status finishGroup(scene::Scene& scene, BakedGroup& group, bool budgeted, const Executor& executor,
                   BakeSummary& summary) {
    auto flat = micromap::flatten(group.baked.set, executor);
    if (!flat) return flat.error().within(group.name);
    micromap::ensureOneRecord(*flat, group.baked.set.format);
    bake::Statistics statistics = group.baked.statistics;
    if (budgeted) {
        statistics.states = countStates(group.baked.set);
        statistics.microTriangles = statistics.states.total();
    }
    count(*flat, statistics, summary);
    const auto& primitives = group.alpha.primitives;
    handOut(primitives, static_cast<int>(scene.micromaps.size()), group.baked, flat->indices);
    for (const auto* primitive : primitives) {
        const auto& indices = primitive->micromapIndices;
        summary.indexBytes += indices.size() * micromap::indexBytes(indices);
    }
    flat->indices.clear();
    scene.micromaps.push_back({std::move(*flat), group.test, group.name});
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
    return {};
}

Result<BakeSummary> bakeScene(scene::Scene& scene, const BakeParameters& parameters, const Executor& executor,
                              ProgressSink& progress) {
    if (auto checked = check(parameters); !checked) return checked.error();
    const Stopwatch watch;
    BakeSummary summary;
    auto groups = bakeGroups(scene, parameters, executor, progress, summary);
    if (!groups) return groups.error();
    if (parameters.budget) fitBudget(scene, *parameters.budget, *groups, summary);
    for (BakedGroup& group : *groups) {
        auto finishedGroup = finishGroup(scene, group, parameters.budget.has_value(), executor, summary);
        if (!finishedGroup) return finishedGroup.error();
    }
    summary.bakeSeconds = watch.seconds();
    return summary;
}

}  // namespace filigree::jobs
