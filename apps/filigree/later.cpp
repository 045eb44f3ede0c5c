#include "command.h"

#include <fmt/format.h>

namespace filigree::app {

void addLater(CLI::App& app, Commands& commands) {
    for (const char* name : {"compress", "expand", "compare", "vq", "render", "grids"}) {
        Command command(app, name, "Not in this version", fmt::format("filigree {} --help", name));
        command.options().group("")->allow_extras();
        command.onRun([name] {
            return Command::report(
                {ErrorKind::usage, fmt::format("{} is not in this version; see filigree --help", name)});
        });
        commands.push_back(command);
    }
}

}  // namespace filigree::app
