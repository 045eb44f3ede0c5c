#include "filigree/jobs/compare.h"

#include "filigree/report/number.h"

#include "bake_options.h"
#include "command.h"
#include "encoded_lines.h"
#include "levels_option.h"
#include "text_table.h"

#include <fmt/format.h>

namespace filigree::app {
namespace {

void printResult(const jobs::CompareSummary& s, const std::vector<unsigned>& states) {
    for (const unsigned count : states) {
        const report::Table table = jobs::comparisonTable(s, count);
        fmt::print("{}\n", oneLine(table.caption));
        printTable(table);
        fmt::print("\n");
    }
    printPairs({{"triangles", fmt::format("{}, of which masked {}", report::formatCount(s.triangles),
                                          report::formatCount(s.maskedTriangles))},
                {"alpha textures", bytesText(s.textureBytes)},
                {"their coordinates", bytesText(s.vertexBytes)},
                {"triangle indices", bytesText(s.triangleIndexBytes)},
                {"seconds", fmt::format("{:.2f}", s.seconds)},
                {"memory", bytesText(s.peakBytes)}});
}

}  // namespace

void addCompare(CLI::App& app, Commands& commands) {
    Command command(app, "compare", "Tell what a scene's micromaps take in every encoding, level by level",
                    "filigree compare forest.glb --levels 1-10");
    const auto options = std::make_shared<jobs::CompareOptions>();
    options->levels = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
    auto& verb = command.options();
    verb.add_option("input", options->input, "The scene; micromaps that it has are passed over")
        ->required()
        ->type_name("IN");
    verb.add_option("-o,--output", options->outputFolder, "A folder for compare.csv and charts")
        ->type_name("DIR");
    verb.add_option("--html", options->page, "A page with the charts and tables")->type_name("FILE");
    addLevelsOption(verb, options->levels, "1-10");
    addBothStates(verb, options->states);
    addTestOptions(verb, options->parameters);
    command.onRun([command, options] {
        auto progress = command.progress();
        return command.finish(
            jobs::compare(*options, *command.executor(), progress),
            [&](const jobs::CompareSummary& summary) { printResult(summary, options->states); });
    });
    commands.push_back(command);
}

}  // namespace filigree::app
