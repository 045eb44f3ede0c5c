#include "filigree/jobs/expand.h"

#include "command.h"
#include "encoded_lines.h"
#include "text_table.h"

#include <fmt/format.h>

namespace filigree::app {
namespace {

void printExpanded(const jobs::ExpandSummary& s) {
    auto lines = encodedLines(s.size);
    lines.emplace_back("flat", bytesText(s.dataBytes));
    lines.emplace_back("seconds", fmt::format("{:.2f}", s.totalSeconds));
    lines.emplace_back("memory", bytesText(s.peakBytes));
    printPairs(lines);
}

}  // namespace

void addExpand(CLI::App& app, Commands& commands) {
    Command command(app, "expand", "Turn encoded micromaps back to what glTF, Vulkan and DXR take",
                    "filigree expand forest.fil --asset forest.glb -o forest-omm.glb");
    const auto options = std::make_shared<jobs::ExpandOptions>();
    auto& verb = command.options();
    verb.add_option("input", options->input, "What compress wrote (.fil)")->required()->type_name("IN");
    verb.add_option("--asset", options->asset, "The scene that it was made from, unchanged")
        ->required()
        ->type_name("SCENE");
    auto* output = verb.add_option("-o,--output", options->output, "Where the scene with micromaps goes")
                       ->type_name("OUT");
    auto* raw = verb.add_option("--raw", options->rawFolder,
                                "A folder for blobs that Vulkan and DXR take as they are")
                    ->type_name("DIR");
    verb.callback([output, raw] {
        if (output->empty() && raw->empty()) throw CLI::RequiredError("-o or --raw");
    });
    command.onRun([command, options] {
        auto progress = command.progress();
        return command.finish(jobs::expand(*options, *command.executor(), progress), printExpanded);
    });
    commands.push_back(command);
}

}  // namespace filigree::app
