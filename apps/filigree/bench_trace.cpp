#include "filigree/jobs/bench_trace.h"

#include "bake_options.h"
#include "command.h"
#include "levels_option.h"
#include "picture_options.h"
#include "text_table.h"

namespace filigree::app {

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
    verb.add_option("--html", options->page, "A page with charts and tables")->type_name("FILE");
    addTestOptions(verb, options->parameters);
    command.onRun([command, options] {
        auto progress = command.progress();
        return command.finish(jobs::benchTrace(*options, *command.executor(), progress),
                              [](const auto& summary) { printTable(jobs::benchTraceTable(summary)); });
    });
    commands.push_back(command);
}

}  // namespace filigree::app
