#include "filigree/jobs/grids.h"

#include "filigree/report/number.h"

#include "command.h"
#include "encoded_lines.h"
#include "parsed_number.h"
#include "picture_options.h"
#include "text_table.h"

#include <fmt/format.h>

namespace filigree::app {
namespace {

using Lines = std::vector<std::pair<std::string, std::string>>;

std::string stepText(const grid::Lattice& lattice) {
    return fmt::format("{:.6g} x {:.6g} x {:.6g}", lattice.step[0], lattice.step[1], lattice.step[2]);
}

Lines linesOf(const jobs::GridsSummary& s) {
    using report::formatCount;
    Lines lines{{"triangles", formatCount(s.statistics.triangles)},
                {"in grids",
                 fmt::format("{}, grids: {}, clusters: {}", report::formatShare(s.statistics.inGridShare()),
                             formatCount(s.grids), formatCount(s.clusters))},
                {"codec", std::string(nameOf(s.codec))}};
    if (s.codec == grid::Codec::lattice) lines.emplace_back("lattice step", stepText(s.lattice));
    if (s.paperRms) lines.emplace_back("paper's RMS", fmt::format("{:.3g}, matched", *s.paperRms));
    if (s.cracks) {
        lines.emplace_back("cracks", fmt::format("at {} of {} shared vertices, up to {:.3g} wide",
                                                 formatCount(s.cracks->cracked),
                                                 formatCount(s.cracks->shared), s.cracks->widest));
    }
    lines.emplace_back("file", bytesText(s.fileBytes));
    lines.emplace_back(
        "seconds",
        fmt::format("read {:.2f}, convert {:.2f}, encode {:.2f}, build {:.2f}, in all {:.2f}", s.readSeconds,
                    s.convertSeconds, s.encodeSeconds, s.buildSeconds, s.totalSeconds));
    return lines;
}

void printGrids(const jobs::GridsSummary& s) {
    printPairs(linesOf(s));
    for (const report::Table& table :
         {jobs::gridMemoryTable(s), jobs::gridErrorTable(s), jobs::gridSizeTable(s)}) {
        if (table.rows.empty()) continue;
        fmt::print("\n");
        printTable(table);
    }
}

// "0.02" is a length, "1e-5d" a share of the diagonal.
void parseMaxError(std::string text, jobs::GridPrecision& precision) {
    precision.isShare = text.ends_with('d');
    const std::string all = text;
    if (precision.isShare) text.pop_back();
    precision.maxError = parsedNumber<double>(text, "--max-error", all);
}

void addPrecision(CLI::App& verb, jobs::GridPrecision& precision) {
    const auto setError = [&precision](const std::string& text) { parseMaxError(text, precision); };
    verb.add_option_function<std::string>(
            "--max-error", setError,
            "lattice: no vertex moves further, in world units; with a d behind it, as a share of the "
            "diagonal of the mesh's box")
        ->type_name("X[d]");
    verb.add_flag("--match-paper", precision.matchPaper,
                  "lattice: the root mean square error of codec paper on this input; the default");
    verb.add_flag("--lossless", precision.lossless,
                  "lattice: every vertex to the bit; for heightfields and quantised meshes");
}

}  // namespace

void addGrids(CLI::App& app, Commands& commands) {
    Command command(app, "grids", "Compress a mesh or heightfield to vertex grids, ready to trace",
                    "filigree grids terrain.png -o terrain.fil --height-scale 0.1");
    const auto options = std::make_shared<jobs::GridsOptions>();
    auto& verb = command.options();
    verb.add_option("input", options->input,
                    "A .glb, .gltf or .ply, or a .png of 16-bit heights; of a scene the opaque triangles")
        ->required()
        ->type_name("IN");
    verb.add_option("-o,--output", options->output, "Where the grids go (.fil)")
        ->required()
        ->type_name("OUT");
    verb.add_option("--codec", options->codec,
                    "paper, 128 bytes for 5 x 5 vertices; lattice, tiles on one integer lattice, the default")
        ->type_name("NAME");
    addPrecision(verb, options->precision);
    verb.add_option("--displacement", options->displacement,
                    "How paper stores displacements: unit-vector, the default, or shared-exponent")
        ->type_name("NAME");
    verb.add_flag("--snap", options->snap, "paper: cut sub-grids further where the surface would crack");
    verb.add_option("--cell", options->cell, "Heights: world units between neighbours; default 1")
        ->type_name("X");
    verb.add_option("--height-scale", options->heightScale, "Heights: world units a grey step; default 1")
        ->type_name("X");
    verb.add_flag("!--no-attributes", options->attributes,
                  "Leave out normals, texture coordinates and the way back to source triangles");
    verb.add_option("--error-map", options->errorMap, "A picture of the error of each sub-grid")
        ->type_name("PNG");
    verb.add_option("--html", options->page,
                    "A page with pictures, the error on the surface, charts and tables")
        ->type_name("FILE");
    addSizeOption(verb, options->width, options->height, "960x540; of the page's pictures");
    verb.add_flag("--zstd", options->zstd, "Compress the sections of the file that become smaller");
    command.onRun([command, options] {
        auto progress = command.progress();
        return command.finish(jobs::grids(*options, *command.executor(), progress), printGrids);
    });
    commands.push_back(command);
}

}  // namespace filigree::app
