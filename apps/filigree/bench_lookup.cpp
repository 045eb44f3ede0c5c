#include "filigree/jobs/bench_lookup.h"

#include "bake_options.h"
#include "command.h"
#include "levels_option.h"
#include "text_table.h"

namespace filigree::app {
namespace {

report::Table tableOf(const jobs::BenchLookupSummary& summary) {
    report::Table table;
    table.columns = {{"scene", "scene"},       {"method", "method"},   {"level", "level"},
                     {"states", "states"},     {"pattern", "pattern"}, {"mode", "mode"},
                     {"ns", "a lookup", "ns"}, {"to_flat", "to flat"}, {"to_dag", "to dag"}};
    const auto cell = [](const std::optional<double>& value) {
        return value ? report::Cell(*value) : report::Cell();
    };
    for (const auto& r : summary.rows) {
        table.rows.push_back({r.scene, r.method, int64_t{r.level}, int64_t{r.states}, r.pattern, r.mode,
                              r.nsPerLookup, cell(r.ratioToFlat), cell(r.ratioToDag)});
    }
    return table;
}

}  // namespace

void addBenchLookup(CLI::App& bench, Commands& commands) {
    Command command(bench, "lookup",
                    "Time lookups in every encoding of a scene's micromaps on one thread, and check that "
                    "all find the same",
                    "filigree bench lookup forest.glb --levels 6,10 --methods flat,dag,sdag");
    const auto options = std::make_shared<jobs::BenchLookupOptions>();
    auto& verb = command.options();
    verb.add_option("inputs", options->inputs, "The scenes; micromaps that they have are passed over")
        ->required()
        ->type_name("IN");
    addLevelsOption(verb, options->levels, "4,6,8,10");
    addBothStates(verb, options->states);
    addMethodsOption(verb, options->methods, "all");
    verb.add_option("--patterns", options->patterns,
                    "random points, hits of ambient-occlusion rays, or both with a comma; default both")
        ->delimiter(',')
        ->type_name("NAMES");
    verb.add_option("--lookups", options->lookups,
                    "Lookups of a run, a 64th of them with tree; default 1048576")
        ->type_name("N");
    verb.add_option("--rounds", options->rounds, "Runs of each row, of which the median counts; default 5")
        ->type_name("N");
    addTestOptions(verb, options->parameters);
    command.onRun([command, options] {
        auto progress = command.progress();
        return command.finish(jobs::benchLookup(*options, *command.executor(), progress),
                              [](const auto& summary) { printTable(tableOf(summary)); });
    });
    commands.push_back(command);
}

}  // namespace filigree::app
