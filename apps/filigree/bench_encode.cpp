#include "filigree/jobs/bench_encode.h"

#include "bake_options.h"
#include "command.h"
#include "levels_option.h"
#include "text_table.h"

namespace filigree::app {
namespace {

report::Table tableOf(const jobs::BenchEncodeSummary& summary) {
    using report::Show;
    report::Table table;
    table.columns = {{"scene", "scene"},
                     {"method", "method"},
                     {"level", "level"},
                     {"states", "states"},
                     {"nodes", "nodes"},
                     {"one", "one thread", "s", Show::plain, 4},
                     {"threads", "threads"},
                     {"all", "all", "s", Show::plain, 4},
                     {"rate", "nodes", "1/s", Show::compact},
                     {"speedup", "speed-up"}};
    for (const auto& r : summary.rows) {
        table.rows.push_back({r.scene, r.method, int64_t{r.level}, int64_t{r.states},
                              static_cast<int64_t>(r.nodes), r.secondsOne, int64_t{r.threads}, r.secondsAll,
                              r.nodesPerSecond, r.speedup});
    }
    return table;
}

}  // namespace

void addBenchEncode(CLI::App& bench, Commands& commands) {
    Command command(bench, "encode",
                    "Time the encoders of micromaps on one thread and on several, and check that the bytes "
                    "are the same",
                    "filigree bench encode forest.glb --levels 8,10 --threads 2");
    const auto options = std::make_shared<jobs::BenchEncodeOptions>();
    auto& verb = command.options();
    verb.add_option("inputs", options->inputs, "The scenes; micromaps that they have are passed over")
        ->required()
        ->type_name("IN");
    addLevelsOption(verb, options->levels, "6,8,10");
    addBothStates(verb, options->states);
    addMethodsOption(verb, options->methods, "tree,indexed-tree,dag,sdag");
    verb.add_option("--rounds", options->rounds, "Runs of each row, of which the median counts; default 5")
        ->type_name("N");
    addTestOptions(verb, options->parameters);
    command.onRun([command, options] {
        auto progress = command.progress();
        return command.finish(jobs::benchEncode(*options, *command.executor(), progress),
                              [](const auto& summary) { printTable(tableOf(summary)); });
    });
    commands.push_back(command);
}

}  // namespace filigree::app
