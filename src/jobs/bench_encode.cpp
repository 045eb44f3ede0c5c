#include "filigree/jobs/bench_encode.h"

#include "filigree/encoding/encode.h"

#include "jobs/encode_scene.h"
#include "jobs/json_text.h"
#include "jobs/level_sweep.h"
#include "jobs/median.h"
#include "jobs/stopwatch.h"

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

using encoding::Encoding;

Status check(const BenchEncodeOptions& options) {
    if (const Status levels = checkLevels(options.levels); !levels) return levels;
    if (options.rounds == 0) return Error{ErrorKind::usage, "--rounds 0: give one or more"};
    return check(options.parameters);
}

Result<std::vector<Encoding>> encodingsOf(const BenchEncodeOptions& options) {
    std::vector<Encoding> encodings;
    for (const std::string& name : options.methods) {
        const auto encoding = findEncoding(name, "--methods");
        if (!encoding) return encoding.error();
        if (*encoding == Encoding::bitmask)
            return Error{ErrorKind::usage, "--methods bitmask: it encodes textures, not quadtrees"};
        encodings.push_back(*encoding);
    }
    return encodings;
}

// Each inner node has four children.
uint64_t nodesOf(const SceneMaps& maps) {
    uint64_t nodes = 0;
    for (const auto& map : maps.views()) {
        uint64_t leaves = 0;
        micromap::forEachLeaf(map, [&](uint64_t, unsigned, micromap::State) { ++leaves; });
        nodes += leaves + (leaves - 1) / 3;
    }
    return nodes;
}

struct Timed {
    encoding::EncodedSet set;
    double seconds = 0;
};

Result<Timed> encodeOnce(const SceneMaps& maps, Encoding encoding, const Executor& executor) {
    const auto views = maps.views();
    const Stopwatch watch;
    auto set = encoding::encode(encoding, views, maps.format, {}, executor);
    if (!set) return set.error().within(std::string(nameOf(encoding)));
    return Timed{std::move(*set), watch.seconds()};
}

// Fills in the times of `row`.
Status measure(const SceneMaps& maps, Encoding encoding, unsigned rounds, const Executor& executor,
               BenchEncodeRow& row) {
    std::vector<double> one;
    std::vector<double> all;
    for (unsigned round = 0; round < rounds; ++round) {
        const auto single = encodeOnce(maps, encoding, serialExecutor());
        if (!single) return single.error();
        const auto threaded = encodeOnce(maps, encoding, executor);
        if (!threaded) return threaded.error();
        if (single->set.payload != threaded->set.payload ||
            single->set.descriptors != threaded->set.descriptors)
            return Error{ErrorKind::format,
                         fmt::format("{}, level {}, {} states: {} makes other bytes on {} threads", row.scene,
                                     row.level, row.states, row.method, row.threads)};
        one.push_back(single->seconds);
        all.push_back(threaded->seconds);
    }
    row.secondsOne = median(one);
    row.secondsAll = median(all);
    row.nodesPerSecond = static_cast<double>(row.nodes) / row.secondsOne;
    row.speedup = medianRatio(one, all);
    return {};
}

Status benchScene(const BenchEncodeOptions& options, const std::vector<Encoding>& encodings,
                  const std::filesystem::path& input, const Executor& executor, ProgressSink& progress,
                  BenchEncodeSummary& summary) {
    auto scene = readUnbaked(input, options.parameters);
    if (!scene) return scene.error();
    for (const unsigned level : options.levels) {
        for (const unsigned states : options.states) {
            const auto maps = bakeAt(*scene, input, options.parameters, level, states, executor, progress);
            if (!maps) return maps.error();
            for (const Encoding encoding : encodings) {
                BenchEncodeRow row{input.filename().string(), std::string(nameOf(encoding)), level, states};
                row.nodes = nodesOf(*maps);
                row.threads = executor.concurrency();
                if (const Status done = measure(*maps, encoding, options.rounds, executor, row); !done)
                    return done;
                summary.rows.push_back(std::move(row));
                if (progress.cancelled()) return Error{ErrorKind::cancelled, "the bench was cancelled"};
            }
        }
    }
    return {};
}

}  // namespace

Result<BenchEncodeSummary> benchEncode(const BenchEncodeOptions& options, const Executor& executor,
                                       ProgressSink& progress) {
    if (const Status checked = check(options); !checked) return checked.error();
    const auto encodings = encodingsOf(options);
    if (!encodings) return encodings.error();
    BenchEncodeSummary summary;
    for (const auto& input : options.inputs) {
        const Status done = benchScene(options, *encodings, input, executor, progress, summary);
        if (!done) return done.error();
    }
    return summary;
}

std::string toJson(const BenchEncodeSummary& summary) {
    Json rows = Json::array();
    for (const BenchEncodeRow& r : summary.rows) {
        rows.push_back({{"scene", r.scene},
                        {"method", r.method},
                        {"level", r.level},
                        {"states", r.states},
                        {"nodes", r.nodes},
                        {"seconds_1", r.secondsOne},
                        {"seconds_n", r.secondsAll},
                        {"threads", r.threads},
                        {"nodes_per_second", r.nodesPerSecond},
                        {"speedup", r.speedup}});
    }
    return dump({{"rows", rows}});
}

}  // namespace filigree::jobs
