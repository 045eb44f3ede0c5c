#include "filigree/jobs/bench.h"

#include "command.h"
#include "text_table.h"

namespace filigree::app {
namespace {

report::Table tableOf(const jobs::BenchBakeSummary& summary) {
    using report::Show;
    report::Table table;
    table.columns = {{"input", "input", ""},
                     {"level", "level", ""},
                     {"states", "states", ""},
                     {"threads", "threads", ""},
                     {"cpu", "CPU", "s", Show::plain, 4},
                     {"wall", "wall", "s", Show::plain, 4},
                     {"rate", "micro-triangles", "1/s", Show::compact},
                     {"bytes", "bytes", "", Show::bytes},
                     {"known", "known", "", Show::share},
                     {"wrong", "wrong", ""},
                     {"over_cautious", "over-cautious", ""},
                     {"checked", "checked", "", Show::compact}};
    const auto whole = [](uint64_t value) { return static_cast<int64_t>(value); };
    for (const auto& r : summary.rows) {
        table.rows.push_back({r.input, whole(r.level), whole(r.states), whole(r.threads), r.cpuSeconds,
                              r.wallSeconds, r.microTrianglesPerSecond, whole(r.bytes), r.knownShare,
                              whole(r.wrong), whole(r.overCautious), whole(r.checked)});
    }
    return table;
}

void addBenchBake(CLI::App& bench, Commands& commands) {
    Command command(bench, "bake",
                    "Time the baker on a leaf and triangles made in code, and check what it made",
                    "filigree bench bake --threads 1");
    const auto options = std::make_shared<jobs::BenchBakeOptions>();
    auto& verb = command.options();
    verb.add_option("--input", options->inputFolder, "Read leaf, quad and rand20k from this folder")
        ->type_name("DIR");
    verb.add_option("--repeats", options->repeats, "Runs of each row, of which the best counts; default 3")
        ->type_name("N")
        ->check(CLI::Range(1, 1000).description(""));
    verb.add_option("--checked", options->checked, "Micro-triangles examined in each row; default 1000000")
        ->type_name("N");
    verb.add_flag("--quick", options->quick, "Only the rows that take under a second");
    command.onRun([command, options] {
        options->threads = command.common().threads;
        auto progress = command.progress();
        return command.finish(jobs::benchBake(*options, progress),
                              [](const auto& summary) { printTable(tableOf(summary)); });
    });
    commands.push_back(command);
}

}  // namespace

void addBench(CLI::App& app, Commands& commands) {
    auto* bench = app.add_subcommand("bench", "The timings of docs/results.md");
    bench->require_subcommand(1);
    addBenchBake(*bench, commands);
    addBenchEncode(*bench, commands);
    addBenchGrids(*bench, commands);
    addBenchLookup(*bench, commands);
    addBenchTrace(*bench, commands);
    addBenchVulkan(*bench, commands);
}

}  // namespace filigree::app
