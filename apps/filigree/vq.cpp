#include "filigree/jobs/vq.h"

#include "filigree/report/number.h"

#include "command.h"
#include "text_table.h"

#include <fmt/format.h>

namespace filigree::app {
namespace {

std::string useText(const jobs::TransformUse& use) {
    return fmt::format("{} of 512 combinations, {} by one map alone, the most frequent by {}",
                       report::formatCount(use.used), report::formatCount(use.unique),
                       report::formatShare(use.mostFrequentShare()));
}

void printSavings(const jobs::VqSummary& s) {
    printTable(jobs::vqTable(s));
    fmt::print("\n");
    uint64_t pairs = 0;
    uint64_t singles = 0;
    for (const jobs::VqTexture& texture : s.textures) {
        pairs += texture.pairs;
        singles += texture.singles;
    }
    std::vector<std::pair<std::string, std::string>> lines{
        {"textures", report::formatCount(s.textures.size())},
        {"pairs",
         fmt::format("{}, single triangles {}", report::formatCount(pairs), report::formatCount(singles))}};
    if (s.vq2.maps > 0) lines.emplace_back("VQ2 transforms", useText(s.vq2));
    if (s.vq4.maps > 0) lines.emplace_back("VQ4 transforms", useText(s.vq4));
    lines.emplace_back("seconds", fmt::format("{:.2f}", s.seconds));
    printPairs(lines);
}

}  // namespace

void addVq(CLI::App& app, Commands& commands) {
    Command command(app, "vq", "Measure what opacity squares, VQ2 and VQ4 save on textures or scenes",
                    "filigree vq leaves/*.png -o leaves-vq");
    const auto options = std::make_shared<jobs::VqOptions>();
    auto& verb = command.options();
    verb.add_option("inputs", options->inputs,
                    "PNGs, one square each over the texels of alpha > 0; scenes, one for each triangle pair")
        ->required()
        ->type_name("IN...");
    verb.add_option("-o,--output", options->outputFolder, "A folder for index.html, charts and pictures")
        ->required()
        ->type_name("DIR");
    verb.add_option("--prefer", options->prefer, "The state that encoders favour; default neither")
        ->type_name("T|O");
    verb.add_option("--cutoff", options->cutoff, "Alpha cutoff; default 0.5, and each material's own")
        ->type_name("0..1");
    verb.add_option("--guard", options->guard,
                    "Widen each region by this before it is decided; default 1/256")
        ->type_name("TEXELS");
    verb.add_option("--limit", options->limit, "The first so many textures; default all")
        ->type_name("N")
        ->check(CLI::NonNegativeNumber);
    verb.add_option("--maps", options->mapsPerTexture,
                    "Of a scene's texture so many distinct pairs, evenly spread; 0 for all; default 64")
        ->check(CLI::NonNegativeNumber)
        ->type_name("N");
    verb.add_flag("!--no-pictures", options->pictures, "Draw no pictures of the maps");
    command.onRun([command, options] {
        auto progress = command.progress();
        return command.finish(jobs::vq(*options, *command.executor(), progress), printSavings);
    });
    commands.push_back(command);
}

}  // namespace filigree::app
