#include "filigree/jobs/bench_vulkan.h"

#include "bake_options.h"
#include "command.h"
#include "levels_option.h"
#include "picture_options.h"
#include "text_table.h"

#include <fmt/format.h>

namespace filigree::app {
namespace {

report::Table frameTable(const jobs::BenchVulkanSummary& summary) {
    using report::Show;
    report::Table table;
    table.columns = {{"scene", "scene"},
                     {"path", "path"},
                     {"method", "method"},
                     {"build", "build"},
                     {"states", "states"},
                     {"level", "level"},
                     {"frame", "frame", "ms", Show::plain, 3},
                     {"ratio", "to texture", "", Show::plain, 3},
                     {"bytes", "opacity", "bytes", Show::bytes}};
    const auto cell = [](const std::optional<unsigned>& value) {
        return value ? report::Cell(int64_t{*value}) : report::Cell();
    };
    for (const auto& r : summary.rows) {
        table.rows.push_back({r.scene, r.path, r.method, r.build ? report::Cell(*r.build) : report::Cell(),
                              cell(r.states), cell(r.level), r.frameMs, r.ratioToTexture,
                              static_cast<int64_t>(r.opacityBytes)});
    }
    return table;
}

void printFrames(const jobs::BenchVulkanSummary& summary) {
    fmt::print("{}, {}\n\n", summary.device, summary.driver);
    printTable(frameTable(summary));
}

void addDevice(CLI::App& verb, jobs::BenchVulkanOptions& options) {
    verb.add_option("--device", options.device, "By number or part of its name; by default the best")
        ->type_name("NAME|N");
    verb.add_option("--path", options.path, "query or pipeline; by default each that the device has")
        ->type_name("NAME");
    verb.add_option("--build", options.builds,
                    "Of hardware micromaps: fast-trace, fast-build or, by default, both")
        ->delimiter(',')
        ->type_name("NAMES");
}

}  // namespace

void addBenchVulkan(CLI::App& bench, Commands& commands) {
    Command command(bench, "vulkan",
                    "Time pictures on a Vulkan device with every way to test alpha, and check that all that "
                    "must draw the same do",
                    "filigree bench vulkan forest.glb --levels 6 --methods texture,micromap,hardware");
    const auto options = std::make_shared<jobs::BenchVulkanOptions>();
    auto& verb = command.options();
    verb.add_option("inputs", options->inputs, "The scenes; micromaps that they have are passed over")
        ->required()
        ->type_name("IN");
    addLevelsOption(verb, options->levels, "2,4,6");
    addBothStates(verb, options->states);
    verb.add_option("--methods", options->methods,
                    "As render's, with commas between them; default all that the device can")
        ->delimiter(',')
        ->type_name("NAMES");
    addDevice(verb, *options);
    verb.add_option("--integrator", options->integrator, "primary, shadow, ao (the default) or path")
        ->type_name("NAME");
    verb.add_option("--spp", options->samples, "Samples a pixel; default 1")->type_name("N");
    verb.add_option("--rounds", options->rounds, "Runs of each row, of which the median counts; default 5")
        ->type_name("N");
    addSizeOption(verb, options->width, options->height, "480x270");
    addCameraOption(verb, options->camera,
                    "the file's first, or a place from which rays meet many alpha tests");
    addTestOptions(verb, options->parameters);
    command.onRun([command, options] {
        auto progress = command.progress();
        return command.finish(jobs::benchVulkan(*options, *command.executor(), progress), printFrames);
    });
    commands.push_back(command);
}

}  // namespace filigree::app
