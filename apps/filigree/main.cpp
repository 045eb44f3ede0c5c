// Arguments in, exit codes out: 0 done, 1 the input or the machine failed, 2 wrong usage.
#include "filigree/core/target.h"

#include "command.h"

#include <cstdio>
#include <exception>
#include <new>

#include <fmt/format.h>

namespace filigree::app {
namespace {

int runChosen(const Commands& commands) {
    for (const auto& command : commands) {
        if (command.chosen()) return command.run();
    }
    return wrongUsage;
}

int run(int argc, char** argv) {
    CLI::App app("Opacity micromaps for finely cut things: bake, check, look, measure.", "filigree");
    app.set_version_flag("--version", "filigree " FILIGREE_VERSION);
    app.footer(
        "filigree VERB --help tells more of each.\nExample: filigree bake forest.glb -o forest-omm.glb");
    app.require_subcommand(1);
    Commands commands;
    addBake(app, commands);
    addCompress(app, commands);
    addExpand(app, commands);
    addCompare(app, commands);
    addValidate(app, commands);
    addInspect(app, commands);
    addVq(app, commands);
    addGrids(app, commands);
    addBench(app, commands);
    addRender(app, commands);
    addDemo(app, commands);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& wanted) {  // --help, --version
        return app.exit(wanted);
    } catch (const CLI::ParseError& wrong) {
        return Command::report({ErrorKind::usage, std::string(wrong.what()) + "; see filigree --help"});
    }
    if (const Status forced = forceTargetFromEnvironment(); !forced) return Command::report(forced.error());
    stopOnSignals();
    return runChosen(commands);
}

}  // namespace
}  // namespace filigree::app

int main(int argc, char** argv) {
    using namespace filigree;
    int code = app::failed;
    try {
        code = app::run(argc, argv);
    } catch (const std::bad_alloc&) {
        code = app::Command::report(
            {ErrorKind::limit, "out of memory; a lower --level or --max-level needs less"});
    } catch (const std::exception& error) {
        code = app::Command::report({ErrorKind::limit, fmt::format("stopped: {}", error.what())});
    }
    if (std::fflush(stdout) != 0 && code == app::done) {
        code = app::Command::report({ErrorKind::file, "cannot write the result to standard output"});
    }
    return code;
}
