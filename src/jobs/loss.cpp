#include "jobs/loss.h"

#include "filigree/encoding/lossy.h"

#include "jobs/map_weights.h"

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

using micromap::Format;

Error usage(std::string message) {
    return {ErrorKind::usage, std::move(message)};
}

Status checkPercent(const char* name, const std::optional<double>& percent) {
    if (!percent || *percent >= 0) return {};
    return usage(fmt::format("{} {}: give a percentage of 0 or more", name, *percent));
}

// Which loss there can be depends on the maps, which a scene may bring.
Status checkStates(const LossOptions& options, Format format) {
    if (options.maxExtraAnyhit && format == Format::twoState)
        return usage("--max-extra-anyhit: 2-state micromaps call no any-hit shader; use --max-changed-area");
    if (options.maxChangedArea && format == Format::fourState)
        return usage("--max-changed-area: is for 2-state micromaps; use --max-extra-anyhit");
    return {};
}

// What a loss is measured against.
struct Reference {
    double area = 0;     // of all
    double unknown = 0;  // of it
    double loss = 0;     // what a loss of 1 stands for

    Reference(const MapWeights& weights, const SceneMaps& maps)
        : area(weights.total), unknown(weights.unknown(maps.maps)) {
        loss = maps.format == Format::fourState && unknown > 0 ? unknown : area;
    }
    [[nodiscard]] RatePoint point(const encoding::LossyPoint& from, Format format) const {
        const double all = unknown + (format == Format::fourState ? from.cost : 0);
        return {from.bytes, loss > 0 ? from.cost / loss : 0, area > 0 ? 1 - all / area : 1};
    }
};

encoding::LossyGoal goalOf(const LossOptions& options, double reference) {
    encoding::LossyGoal goal;
    goal.maxBytes = options.maxBytes;
    const auto& percent = options.maxExtraAnyhit ? options.maxExtraAnyhit : options.maxChangedArea;
    if (percent) goal.maxCost = *percent / 100 * reference;
    return goal;
}

std::vector<encoding::WeightedMap> weightedMaps(const SceneMaps& maps, const MapWeights& weights) {
    std::vector<encoding::WeightedMap> list;
    for (size_t k = 0; k < maps.maps.size(); ++k) list.push_back({maps.maps[k], weights.ofMap[k]});
    return list;
}

}  // namespace

Status check(const LossOptions& options, encoding::Encoding encoding) {
    const int chosen = (options.maxBytes ? 1 : 0) + (options.maxExtraAnyhit ? 1 : 0) +
                       (options.maxChangedArea ? 1 : 0) + (options.oneBit ? 1 : 0);
    if (chosen == 0) return {};
    if (chosen > 1)
        return usage("--max-bytes, --max-extra-anyhit, --max-changed-area, --one-bit: choose one of them");
    if (encoding == encoding::Encoding::bitmask)
        return usage(fmt::format("{}: bitmask encodes textures, which lose nothing",
                                 options.oneBit ? "--one-bit" : "--max-..."));
    if (const Status checked = checkPercent("--max-extra-anyhit", options.maxExtraAnyhit); !checked)
        return checked;
    return checkPercent("--max-changed-area", options.maxChangedArea);
}

Result<encoding::EncodedSet> encodeWithLoss(const scene::Scene& scene, SceneMaps& maps,
                                            const LossyTarget& target, const LossOptions& options,
                                            const Executor& executor, ProgressSink& progress,
                                            LossySummary& summary) {
    if (const Status checked = checkStates(options, maps.format); !checked) return checked.error();
    const MapWeights weights = weightsOf(scene, maps);
    const Reference reference(weights, maps);
    auto lossy = encoding::encodeLossy(target.encoding, weightedMaps(maps, weights), target.format,
                                       target.options, goalOf(options, reference.loss), executor, progress);
    if (!lossy && lossy.error().kind == ErrorKind::limit && options.maxBytes)
        return lossy.error().within(fmt::format("--max-bytes {}", *options.maxBytes));
    if (!lossy) return lossy.error();
    summary.states = maps.format == Format::twoState ? 2 : 4;
    summary.anyhitShare = reference.area > 0 ? reference.unknown / reference.area : 0;
    summary.chosen = reference.point(lossy->point, maps.format);
    for (const auto& point : lossy->curve) summary.curve.push_back(reference.point(point, maps.format));
    replaceMaps(maps, std::move(lossy->maps), lossy->indices);
    return std::move(lossy->set);
}

report::Table rateTable(const LossySummary& summary) {
    using report::Show;
    const bool fourState = summary.states == 4;
    report::Table table;
    table.caption = "Rate curve: what other bounds would give";
    table.columns = {{"bytes", "bytes", "", Show::bytes}, {"of_lossless", "of lossless", "", Show::share}};
    if (fourState) {
        table.columns.push_back({"extra_anyhit", "more any-hit calls", "", Show::share});
        table.columns.push_back({"known_share", "known", "", Show::share});
    } else {
        table.columns.push_back({"changed_area", "changed area", "", Show::share});
    }
    const auto lossless = static_cast<double>(summary.curve.front().bytes);
    for (const RatePoint& point : summary.curve) {
        auto& row = table.rows.emplace_back();
        const double share = lossless > 0 ? static_cast<double>(point.bytes) / lossless : 1;
        row = {static_cast<int64_t>(point.bytes), share, point.loss};
        if (fourState) row.emplace_back(point.knownShare);
    }
    return table;
}

}  // namespace filigree::jobs
