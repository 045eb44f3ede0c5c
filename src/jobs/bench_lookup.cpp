#include "filigree/jobs/bench_lookup.h"

#include "jobs/encode_scene.h"
#include "jobs/json_text.h"
#include "jobs/level_sweep.h"
#include "jobs/lookup_method.h"
#include "jobs/lookup_queries.h"
#include "jobs/median.h"

#include <algorithm>
#include <array>
#include <map>
#include <memory>

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

using encoding::Encoding;
using micromap::Format;
using micromap::State;

constexpr uint64_t fewestLookups = 2;
constexpr uint64_t mostLookups = uint64_t{1} << 26;
constexpr std::string_view hits = "hits";
constexpr size_t treeShare = 64;  // the tree looks up one point of so many

Status check(const BenchLookupOptions& options) {
    if (const Status levels = checkLevels(options.levels); !levels) return levels;
    if (options.lookups < fewestLookups || options.lookups > mostLookups)
        return Error{ErrorKind::usage,
                     fmt::format("--lookups {}: give {} to {}", options.lookups, fewestLookups, mostLookups)};
    if (options.rounds == 0) return Error{ErrorKind::usage, "--rounds 0: give one or more"};
    for (const std::string& pattern : options.patterns) {
        if (pattern != "random" && pattern != hits)
            return Error{ErrorKind::usage,
                         fmt::format("--patterns {}: choose random, hits or both", pattern)};
    }
    return check(options.parameters);
}

// The encodings asked for, in their own order, and always flat: the others are compared with it.
Result<std::vector<Encoding>> encodingsOf(const BenchLookupOptions& options) {
    std::vector<Encoding> encodings{Encoding::flat};
    for (const std::string& name : options.methods) {
        const auto encoding = findEncoding(name, "--methods");
        if (!encoding) return encoding.error();
        encodings.push_back(*encoding);
    }
    if (options.methods.empty()) {
        for (unsigned k = 0; k < encoding::encodingCount; ++k) encodings.push_back(static_cast<Encoding>(k));
    }
    std::ranges::sort(encodings);
    encodings.erase(std::unique(encodings.begin(), encodings.end()), encodings.end());
    return encodings;
}

// A scene at one level, baked in both ways.
struct BakedLevel {
    const scene::Scene& scene;
    std::string name;
    unsigned level = 0;
    SceneMaps twoState;
    SceneMaps fourState;
    const std::vector<TestedPoint>& points;  // for the pattern `hits`
};

// The lookups of one scene, level, number of states and pattern: all methods in turn, several times.
class Contest {
  public:
    Contest(const BenchLookupOptions& options, const BakedLevel& baked, unsigned states,
            std::string_view pattern)
        : options_(options),
          baked_(baked),
          states_(states),
          pattern_(pattern),
          queries_(pattern == hits ? hitQueries(maps(), baked.fourState, baked.points, options.lookups)
                                   : randomQueries(maps(), baked.fourState, options.lookups)),
          exact_(queries_.size()),
          found_(queries_.size()) {}

    [[nodiscard]] bool hasPoints() const { return queries_.size() > 0; }

    Status add(Encoding encoding, const Executor& executor) {
        const Format format = states_ == 2 ? Format::twoState : Format::fourState;
        BakeParameters parameters;
        parameters.states = states_;
        const bool cautious = parametersFor(encoding, parameters).states == 4;
        auto set = encodeMaps(baked_.scene, cautious ? baked_.fourState : maps(), encoding, format, executor);
        if (!set) return set.error();
        auto method = lookupMethod(std::move(*set), queries_);
        if (!method) return method.error();
        methods_.push_back(std::move(*method));
        return {};
    }

    // The first method, flat, tells what is right.
    Status run(ProgressSink& progress) {
        methods_.front()->run(LookupMode::independent, exact_);
        for (unsigned round = 0; round < options_.rounds; ++round) {
            for (const LookupMode mode : lookupModes) {
                for (const auto& method : methods_) {
                    if (const Status ran = runOnce(*method, mode); !ran) return ran;
                }
            }
            if (progress.cancelled()) return Error{ErrorKind::cancelled, "the bench was cancelled"};
        }
        return {};
    }

    void addRows(std::vector<BenchLookupRow>& rows) const {
        for (const auto& method : methods_) {
            const Encoding encoding = method->encoding();
            if (!options_.methods.empty() &&
                std::ranges::find(options_.methods, nameOf(encoding)) == options_.methods.end())
                continue;
            for (const LookupMode mode : lookupModes) {
                const std::vector<double>& times = times_.at({encoding, mode});
                rows.push_back({baked_.name, std::string(nameOf(encoding)), baked_.level, states_,
                                std::string(pattern_), std::string(nameOf(mode)), median(times),
                                ratio(times, Encoding::flat, mode), ratio(times, Encoding::dag, mode)});
            }
        }
    }

  private:
    [[nodiscard]] const SceneMaps& maps() const { return states_ == 2 ? baked_.twoState : baked_.fourState; }

    Status runOnce(const LookupMethod& method, LookupMode mode) {
        const size_t count = method.encoding() == Encoding::tree
                                 ? std::max<size_t>(queries_.size() / treeShare, fewestLookups)
                                 : queries_.size();
        const auto states = std::span(found_).first(count);
        const double seconds = method.run(mode, states);
        const size_t lookups = lookupsOf(mode, count);
        times_[{method.encoding(), mode}].push_back(seconds / static_cast<double>(lookups) * 1e9);
        return compare(method, mode, states.first(lookups));
    }

    [[nodiscard]] Status compare(const LookupMethod& method, LookupMode mode,
                                 std::span<const State> states) const {
        size_t query = 0;
        for (size_t k = 0; k < states.size(); ++k) {
            if (!method.agrees(query, exact_[query], states[k]))
                return Error{ErrorKind::format,
                             fmt::format("{}, level {}, {} states: {} finds state {} at point {}, flat {}",
                                         baked_.name, baked_.level, states_, nameOf(method.encoding()),
                                         static_cast<unsigned>(states[k]), query,
                                         static_cast<unsigned>(exact_[query]))};
            query = mode == LookupMode::dependent ? nextPoint(k, states[k]) : k + 1;
        }
        return {};
    }

    [[nodiscard]] std::optional<double> ratio(const std::vector<double>& times, Encoding to,
                                              LookupMode mode) const {
        const auto others = times_.find({to, mode});
        if (others == times_.end()) return std::nullopt;
        return medianRatio(times, others->second);
    }

    const BenchLookupOptions& options_;
    const BakedLevel& baked_;
    unsigned states_;
    std::string_view pattern_;
    LookupQueries queries_;
    std::vector<State> exact_;  // of all points
    std::vector<State> found_;
    std::vector<std::unique_ptr<LookupMethod>> methods_;
    std::map<std::pair<Encoding, LookupMode>, std::vector<double>> times_;  // ns a lookup, by round
};

Status benchPattern(const BenchLookupOptions& options, const std::vector<Encoding>& encodings,
                    const BakedLevel& baked, unsigned states, std::string_view pattern,
                    const Executor& executor, ProgressSink& progress, BenchLookupSummary& summary) {
    Contest contest(options, baked, states, pattern);
    if (!contest.hasPoints()) {
        summary.notes.push_back(fmt::format("{}, level {}, {} states, {}: no triangle needs a lookup",
                                            baked.name, baked.level, states, pattern));
        return {};
    }
    for (const Encoding encoding : encodings) {
        if (const Status added = contest.add(encoding, executor); !added) return added;
    }
    if (const Status ran = contest.run(progress); !ran) return ran;
    contest.addRows(summary.rows);
    return {};
}

Status benchLevel(const BenchLookupOptions& options, const std::vector<Encoding>& encodings,
                  const BakedLevel& baked, const Executor& executor, ProgressSink& progress,
                  BenchLookupSummary& summary) {
    for (const unsigned states : options.states) {
        for (const std::string& pattern : options.patterns) {
            const Status done =
                benchPattern(options, encodings, baked, states, pattern, executor, progress, summary);
            if (!done) return done;
        }
    }
    return {};
}

Status benchScene(const BenchLookupOptions& options, const std::vector<Encoding>& encodings,
                  const std::filesystem::path& input, const Executor& executor, ProgressSink& progress,
                  BenchLookupSummary& summary) {
    auto scene = readUnbaked(input, options.parameters);
    if (!scene) return scene.error();
    std::vector<TestedPoint> points;
    if (std::ranges::find(options.patterns, hits) != options.patterns.end())
        points = testedPoints(*scene, options.parameters.includeBlend);
    for (const unsigned level : options.levels) {
        auto two = bakeAt(*scene, input, options.parameters, level, 2, executor, progress);
        if (!two) return two.error();
        auto four = bakeAt(*scene, input, options.parameters, level, 4, executor, progress);
        if (!four) return four.error();
        const BakedLevel baked{*scene,          input.filename().string(), level,
                               std::move(*two), std::move(*four),          points};
        if (const Status done = benchLevel(options, encodings, baked, executor, progress, summary); !done)
            return done;
    }
    return {};
}

}  // namespace

Result<BenchLookupSummary> benchLookup(const BenchLookupOptions& options, const Executor& executor,
                                       ProgressSink& progress) {
    if (const Status checked = check(options); !checked) return checked.error();
    const auto encodings = encodingsOf(options);
    if (!encodings) return encodings.error();
    BenchLookupSummary summary;
    summary.notes.emplace_back("triangles with special indices need no lookup and are left out");
    for (const auto& input : options.inputs) {
        const Status done = benchScene(options, *encodings, input, executor, progress, summary);
        if (!done) return done.error();
    }
    return summary;
}

std::string toJson(const BenchLookupSummary& summary) {
    const auto orNull = [](const std::optional<double>& value) { return value ? Json(*value) : Json(); };
    Json rows = Json::array();
    for (const BenchLookupRow& r : summary.rows) {
        rows.push_back({{"scene", r.scene},
                        {"method", r.method},
                        {"level", r.level},
                        {"states", r.states},
                        {"pattern", r.pattern},
                        {"mode", r.mode},
                        {"ns_per_lookup", r.nsPerLookup},
                        {"ratio_to_flat", orNull(r.ratioToFlat)},
                        {"ratio_to_dag", orNull(r.ratioToDag)}});
    }
    return dump({{"rows", rows}});
}

}  // namespace filigree::jobs
