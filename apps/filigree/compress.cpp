#include "filigree/jobs/compress.h"

#include "filigree/report/number.h"

#include "bake_options.h"
#include "command.h"
#include "encoded_lines.h"
#include "text_table.h"

#include <fmt/format.h>

namespace filigree::app {
namespace {

void printResult(const jobs::CompressSummary& s) {
    auto lines = encodedLines(s.size);
    lines.insert(lines.begin(),
                 {"triangles", fmt::format("{}, of which masked {}", report::formatCount(s.triangles),
                                           report::formatCount(s.maskedTriangles))});
    lines.emplace_back("file", fmt::format("{}, of which indices {} before compression of the file",
                                           bytesText(s.fileBytes), bytesText(s.indexBytes)));
    lines.emplace_back("seconds",
                       fmt::format("read {:.2f}, {} {:.2f}, encode {:.2f}, write {:.2f}, in all {:.2f}",
                                   s.readSeconds, s.baked ? "bake" : "gather", s.bakeSeconds, s.encodeSeconds,
                                   s.writeSeconds, s.totalSeconds));
    lines.emplace_back("memory", bytesText(s.peakBytes));
    printPairs(lines);
}

}  // namespace

void addCompress(CLI::App& app, Commands& commands) {
    Command command(app, "compress", "Bake a scene and keep its micromaps in a small encoding",
                    "filigree compress forest.glb -o forest.fil --encoding sdag --level 8");
    const auto options = std::make_shared<jobs::CompressOptions>();
    auto& verb = command.options();
    verb.add_option("input", options->input,
                    "The scene; its own micromaps are taken if it has any and no bake option is given")
        ->required()
        ->type_name("IN");
    verb.add_option("-o,--output", options->output, "Where the encoded micromaps go (.fil)")
        ->required()
        ->type_name("OUT");
    verb.add_option("--encoding", options->encoding,
                    "flat, gruen, bitmask, tree, indexed-tree, dag or sdag, the default")
        ->type_name("NAME");
    verb.add_flag("--zstd", options->zstd, "Compress the sections of the file that become smaller");
    addMapOptions(verb, options->parameters);
    command.onRun([command, options] {
        options->bakeAnew = hasMapOptions(command.options());
        auto progress = command.progress();
        return command.finish(jobs::compress(*options, *command.executor(), progress), printResult);
    });
    commands.push_back(command);
}

}  // namespace filigree::app
