#include "filigree/jobs/compress.h"

#include "filigree/report/number.h"

#include "bake_options.h"
#include "command.h"
#include "encoded_lines.h"
#include "text_table.h"

#include <fmt/format.h>

namespace filigree::app {
namespace {

using Lines = std::vector<std::pair<std::string, std::string>>;

void addLossy(const jobs::LossySummary& s, Lines& lines) {
    const std::string loss = report::formatShare(s.chosen.loss);
    lines.emplace_back("loss", s.states == 2 ? fmt::format("{} of the area is on the other side", loss)
                                             : fmt::format("{} more expected any-hit calls, {} known", loss,
                                                           report::formatShare(s.chosen.knownShare)));
}

void addOneBit(const jobs::OneBitSummary& s, Lines& lines) {
    const auto against = [&](uint64_t bytes) {
        return bytes > 0 ? fmt::format("{:.3f}x", static_cast<double>(s.bytes) / static_cast<double>(bytes))
                         : std::string("-");
    };
    lines.emplace_back("pairs", fmt::format("{{T,O}} {}, {{T,U}} {}, {{U,O}} {}, in {}",
                                            report::formatCount(s.maps[0]), report::formatCount(s.maps[1]),
                                            report::formatCount(s.maps[2]), bytesText(s.pairBytes)));
    lines.emplace_back("one bit",
                       fmt::format("{}: {} of 4 states' {}, {} of 2 states' {}", bytesText(s.bytes),
                                   against(s.fourStateBytes), bytesText(s.fourStateBytes),
                                   against(s.twoStateBytes), bytesText(s.twoStateBytes)));
    lines.emplace_back("known", fmt::format("{}, with 4 states {}", report::formatShare(s.knownShare),
                                            report::formatShare(s.fourStateKnownShare)));
}

void printCompressed(const jobs::CompressSummary& s) {
    auto lines = encodedLines(s.size);
    lines.insert(lines.begin(),
                 {"triangles", fmt::format("{}, of which masked {}", report::formatCount(s.triangles),
                                           report::formatCount(s.maskedTriangles))});
    if (s.lossy) addLossy(*s.lossy, lines);
    if (s.oneBit) addOneBit(*s.oneBit, lines);
    lines.emplace_back("file", fmt::format("{}, of which indices {} before compression of the file",
                                           bytesText(s.fileBytes), bytesText(s.indexBytes)));
    lines.emplace_back("seconds",
                       fmt::format("read {:.2f}, {} {:.2f}, encode {:.2f}, write {:.2f}, in all {:.2f}",
                                   s.readSeconds, s.baked ? "bake" : "gather", s.bakeSeconds, s.encodeSeconds,
                                   s.writeSeconds, s.totalSeconds));
    lines.emplace_back("memory", bytesText(s.peakBytes));
    printPairs(lines);
    if (s.lossy) {
        fmt::print("\n");
        printTable(jobs::rateTable(*s.lossy));
    }
}

void addLossOptions(CLI::App& verb, jobs::LossOptions& loss) {
    const auto setBytes = [&loss](const std::string& text) {
        loss.maxBytes = parseBytes("--max-bytes", text);
    };
    verb.add_option_function<std::string>(
            "--max-bytes", setBytes,
            "Give up known parts until payload and descriptors fit; K, M, G are 1024s")
        ->type_name("BYTES");
    verb.add_option("--max-extra-anyhit", loss.maxExtraAnyhit,
                    "4-state: fewest bytes with at most so many per cent more expected any-hit calls")
        ->type_name("PERCENT");
    verb.add_option("--max-changed-area", loss.maxChangedArea,
                    "2-state: fewest bytes with at most so many per cent of the area on the other side")
        ->type_name("PERCENT");
    verb.add_flag("--one-bit", loss.oneBit,
                  "One bit a micro-triangle: what is known of one side, the rest unknown");
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
                    "flat, gruen, bitmask, tree, indexed-tree, dag or sdag, the default; squares of triangle "
                    "pairs: vq2, vq2+, vq4, vq4+")
        ->type_name("NAME");
    verb.add_flag("--zstd", options->zstd, "Compress the sections of the file that become smaller");
    verb.add_flag("--aggregates", options->aggregates,
                  "sdag: store the opaque share of interior nodes, for lookups at coarser levels");
    addLossOptions(verb, options->loss);
    addMapOptions(verb, options->parameters);
    command.onRun([command, options] {
        options->bakeAnew = hasMapOptions(command.options());
        auto progress = command.progress();
        return command.finish(jobs::compress(*options, *command.executor(), progress), printCompressed);
    });
    commands.push_back(command);
}

}  // namespace filigree::app
