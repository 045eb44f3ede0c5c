#include "filigree/jobs/validate.h"

#include "filigree/report/number.h"

#include "command.h"
#include "text_table.h"

#include <fmt/format.h>

namespace filigree::app {
namespace {

void printValidation(const jobs::ValidateSummary& s) {
    using report::formatCount;
    for (const auto& breach : s.breaches)
        fmt::print("{}\n", oneLine(breach.path + ": " + breach.rule + ": " + breach.message));
    if (s.deep) {
        printPairs({{"micro-triangles", formatCount(s.deep->microTriangles)},
                    {"wrong", formatCount(s.deep->wrong)},
                    {"over-cautious", formatCount(s.deep->overCautious)},
                    {"uncertain", formatCount(s.deep->uncertain)}});
    }
    fmt::print("{}\n", s.valid() ? "valid" : "not valid");
}

}  // namespace

void addValidate(CLI::App& app, Commands& commands) {
    Command command(app, "validate",
                    "Check a file's micromaps against every rule, and against their textures",
                    "filigree validate forest-omm.glb --deep");
    const auto options = std::make_shared<jobs::ValidateOptions>();
    auto& verb = command.options();
    verb.add_option("input", options->input, "A .glb, .gltf or .fil, or a folder that bake --raw wrote")
        ->required()
        ->type_name("FILE");
    auto* deep = verb.add_flag("--deep", options->deep, "Examine every micro-triangle against its texture");
    verb.add_option("--sample", options->sample,
                    "With --deep, the share of micro-triangles to examine; default 1")
        ->type_name("0..1")
        ->needs(deep);
    command.onRun([command, options] {
        auto progress = command.progress();
        const auto result = jobs::validate(*options, *command.executor(), progress);
        const int code = command.finish(result, printValidation);
        return code == done && !result->valid() ? failed : code;
    });
    commands.push_back(command);
}

}  // namespace filigree::app
