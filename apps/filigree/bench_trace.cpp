#include "filigree/jobs/bench_trace.h"

#include "bake_options.h"
#include "command.h"
#include "levels_option.h"
#include "picture_options.h"
#include "text_table.h"

namespace filigree::app {
namespace {

report::Table tableOf(const jobs::BenchTraceSummary& summary) {
    using report::Show;
    report::Table table;
    table.columns = {{"scene", "scene"},
                     {"rays", "rays"},
                     {"method", "method"},
                     {"states", "states"},
                     {"level", "level"},
                     {"mrays", "speed", "Mrays/s", Show::plain, 3},
                     {"ratio", "to texture", "", Show::plain, 3},
                     {"least", "least", "", Show::plain, 3},
                     {"most", "most", "", Show::plain, 3},
                     {"tests", "tests a ray", "", Show::plain, 3},
                     {"fetches", "fetches a ray", "", Show::plain, 3},
                     {"bits", "bits a lookup", "", Show::plain, 1},
                     {"bytes", "opacity", "bytes", Show::bytes}};
    const auto cell = [](const std::optional<unsigned>& value) {
        return value ? report::Cell(int64_t{*value}) : report::Cell();
    };
    for (const auto& r : summary.rows) {
        table.rows.push_back({r.scene, r.rays, r.method, cell(r.states), cell(r.level), r.mraysPerSecond,
                              r.ratioToTexture, r.leastRatio, r.mostRatio, r.testsPerRay, r.fetchesPerRay,
                              r.bitsPerLookup, static_cast<int64_t>(r.opacityBytes)});
    }
    return table;
}

}  // namespace

void addBenchTrace(CLI::App& bench, Commands& commands) {
    Command command(
        bench, "trace",
        "Time rays on one thread with every way to test alpha, and check that all that must find "
        "the same hits do",
        "filigree bench trace forest.glb --levels 6 --methods texture,micromap,sdag --atlas 4096");
    const auto options = std::make_shared<jobs::BenchTraceOptions>();
    auto& verb = command.options();
    verb.add_option("inputs", options->inputs, "The scenes; micromaps that they have are passed over")
        ->required()
        ->type_name("IN");
    addLevelsOption(verb, options->levels, "4,6,8");
    addBothStates(verb, options->states);
    verb.add_option("--methods", options->methods, "As render's, with commas between them; default all")
        ->delimiter(',')
        ->type_name("NAMES");
    verb.add_option("--rays", options->rays, "Of primary, shadow, ao and path; default the first three")
        ->delimiter(',')
        ->type_name("NAMES");
    verb.add_option("--rounds", options->rounds, "Runs of each row, of which the median counts; default 5")
        ->type_name("N");
    addSizeOption(verb, options->width, options->height, "480x270");
    addCameraOption(verb, options->camera,
                    "the file's first, or a place from which rays meet many alpha tests");
    verb.add_flag("--overview", options->overview, "Without a camera look at the scene as render does");
    verb.add_option("--atlas", options->atlas,
                    "Pack the masked textures into one RGBA image of so many texels a side first")
        ->type_name("N");
    addTestOptions(verb, options->parameters);
    command.onRun([command, options] {
        auto progress = command.progress();
        return command.finish(jobs::benchTrace(*options, *command.executor(), progress),
                              [](const auto& summary) { printTable(tableOf(summary)); });
    });
    commands.push_back(command);
}

}  // namespace filigree::app
