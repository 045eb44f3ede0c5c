#include "filigree/jobs/bench.h"

#include "filigree/bake/bake.h"
#include "filigree/verify/verify.h"

#include "jobs/bench_input.h"
#include "jobs/json_text.h"
#include "jobs/stopwatch.h"

#include <algorithm>
#include <array>
#include <ctime>

namespace filigree::jobs {
namespace {

// CPU time of the whole process, all threads.
double cpuSeconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct RowPlan {
    std::string_view input;
    unsigned level;
    bool quick;  // takes well under a second
};

constexpr std::array<RowPlan, 8> plans{{{"quad", 4, true},
                                        {"quad", 6, true},
                                        {"quad", 8, true},
                                        {"quad", 9, true},
                                        {"quad", 10, true},
                                        {"quad", 12, true},
                                        {"rand20k", 4, true},
                                        {"rand20k", 6, false}}};

image::AlphaTest benchTest() {
    image::AlphaTest test;
    test.cutoff = 0.5;
    test.guard = 0;
    return test;
}

bake::Settings settingsOf(const BenchBakeRow& row) {
    bake::Settings settings;
    settings.level = row.level;
    settings.format = row.states == 2 ? micromap::Format::twoState : micromap::Format::fourState;
    return settings;
}

// One timed bake to flat micromaps; keeps the best times in `row`.
Result<micromap::FlatSet> timeOnce(const BenchInput& input, const std::vector<mesh::UvTriangle>& triangles,
                                   const Executor& executor, BenchBakeRow& row) {
    const Stopwatch wall;
    const double cpu = cpuSeconds();
    auto baked =
        bake::bake(triangles, input.texture, benchTest(), settingsOf(row), executor, silentProgress());
    if (!baked) return baked.error();
    auto flat = micromap::flatten(baked->set, executor);
    if (!flat) return flat.error();
    row.cpuSeconds = std::min(row.cpuSeconds, cpuSeconds() - cpu);
    row.wallSeconds = std::min(row.wallSeconds, wall.seconds());
    const bake::Statistics& statistics = baked->statistics;
    const auto all = static_cast<double>(statistics.microTriangles);
    row.microTrianglesPerSecond = all / row.wallSeconds;
    row.knownShare = static_cast<double>(statistics.states.known()) / all;
    row.bytes = flat->data.size() + flat->records.size() * micromap::recordBytes;
    return flat;
}

Status check(const BenchInput& input, const std::vector<mesh::UvTriangle>& triangles,
             const micromap::FlatSet& set, uint64_t wanted, BenchBakeRow& row) {
    verify::DeepSettings settings;
    const double all =
        static_cast<double>(triangles.size()) * static_cast<double>(micromap::microTriangleCount(row.level));
    settings.sample = std::min(1.0, static_cast<double>(wanted) / all);
    settings.specialFormat = settingsOf(row).format;
    const auto executor = makeThreadedExecutor(0);
    auto counts =
        verify::deepCheck(triangles, set, input.texture, benchTest(), settings, *executor, silentProgress());
    if (!counts) return counts.error();
    row.wrong = counts->wrong;
    row.overCautious = counts->overCautious;
    row.checked = counts->microTriangles;
    return {};
}

Result<BenchBakeRow> benchRow(const BenchInput& input, const RowPlan& plan, unsigned states,
                              const BenchBakeOptions& options, const Executor& executor) {
    const std::vector<mesh::UvTriangle>& triangles = plan.input == "quad" ? input.quad : input.rand20k;
    BenchBakeRow row;
    row.input = plan.input;
    row.level = plan.level;
    row.states = states;
    row.threads = executor.concurrency();
    row.cpuSeconds = 1e300;
    row.wallSeconds = 1e300;
    for (unsigned r = 0; r < std::max(1u, options.repeats); ++r) {
        auto flat = timeOnce(input, triangles, executor, row);
        if (!flat) return flat.error();
        if (r > 0) continue;
        if (auto checked = check(input, triangles, *flat, options.checked, row); !checked)
            return checked.error();
    }
    return row;
}

}  // namespace

Result<BenchBakeSummary> benchBake(const BenchBakeOptions& options, ProgressSink& progress) {
    auto input = options.inputFolder.empty() ? Result<BenchInput>(makeBenchInput())
                                             : readBenchInput(options.inputFolder);
    if (!input) return input.error();
    const auto executor = makeThreadedExecutor(options.threads);
    BenchBakeSummary summary;
    progress.begin("bench bake", 2 * plans.size(), "rows");
    for (const unsigned states : {4u, 2u}) {
        for (const RowPlan& plan : plans) {
            if (plan.quick || !options.quick) {
                auto row = benchRow(*input, plan, states, options, *executor);
                if (!row) return row.error();
                summary.rows.push_back(std::move(*row));
            }
            progress.advance(1);
            if (progress.cancelled()) return Error{ErrorKind::cancelled, "the bench was cancelled"};
        }
    }
    progress.end();
    return summary;
}

std::string toJson(const BenchBakeSummary& summary) {
    Json rows = Json::array();
    for (const BenchBakeRow& r : summary.rows) {
        rows.push_back({{"input", r.input},
                        {"level", r.level},
                        {"states", r.states},
                        {"threads", r.threads},
                        {"cpu_seconds", r.cpuSeconds},
                        {"wall_seconds", r.wallSeconds},
                        {"micro_triangles_per_second", r.microTrianglesPerSecond},
                        {"bytes", r.bytes},
                        {"known_share", r.knownShare},
                        {"wrong", r.wrong},
                        {"over_cautious", r.overCautious},
                        {"checked", r.checked}});
    }
    return dump({{"rows", rows}});
}

}  // namespace filigree::jobs
