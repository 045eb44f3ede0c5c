#include "filigree/jobs/demo.h"

#include "filigree/report/number.h"

#include "bake_options.h"
#include "command.h"

#include <fmt/format.h>

namespace filigree::app {

void addDemo(CLI::App& app, Commands& commands) {
    Command command(app, "demo", "Make a scene in code, bake it, check it and draw it",
                    "filigree demo -o out/demo");
    const auto options = std::make_shared<jobs::DemoOptions>();
    auto& verb = command.options();
    verb.add_option("-o,--output", options->outputFolder,
                    "A folder for index.html, the pictures and the scenes")
        ->required()
        ->type_name("DIR");
    verb.add_option("--spp", options->samples, "Samples a pixel of the views (default: 8)")->type_name("N");
    addBakeOptions(verb, options->parameters);
    command.onRun([command, options] {
        auto progress = command.progress();
        return command.finish(jobs::demo(*options, *command.executor(), progress), [](const auto& summary) {
            printSummary(summary.bake);
            fmt::print("terrain: {} triangles in {:.3f} bytes each, {}\n",
                       report::formatCount(summary.grids.statistics.triangles),
                       summary.grids.bytesPerTriangle(), summary.terrain.string());
            fmt::print("{} pictures, {}\n", summary.inspection.pictures.size(), summary.page.string());
        });
    });
    commands.push_back(command);
}

}  // namespace filigree::app
