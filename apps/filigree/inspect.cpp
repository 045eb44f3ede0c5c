#include "filigree/jobs/inspect.h"

#include "bake_options.h"
#include "command.h"

#include <fmt/format.h>

namespace filigree::app {

void addInspect(CLI::App& app, Commands& commands) {
    Command command(app, "inspect", "Explore a scene's micromaps over their textures, in one page",
                    "filigree inspect forest-omm.glb -o forest-pictures");
    const auto options = std::make_shared<jobs::InspectOptions>();
    auto& verb = command.options();
    verb.add_option("input", options->input, "The scene; without micromaps it is baked in memory")
        ->required()
        ->type_name("IN");
    verb.add_option("-o,--output", options->outputFolder, "A folder for index.html and the pictures")
        ->required()
        ->type_name("DIR");
    verb.add_flag("--full", options->full,
                  "Put everything into the page, however large it gets; default under 10 MB");
    addBakeOptions(verb, options->parameters);
    command.onRun([command, options] {
        auto progress = command.progress();
        return command.finish(
            jobs::inspect(*options, *command.executor(), progress), [](const auto& summary) {
                fmt::print("{} pictures, {}\n", summary.pictures.size(), summary.page.string());
            });
    });
    commands.push_back(command);
}

}  // namespace filigree::app
