#include "filigree/jobs/render.h"

#include "filigree/report/number.h"

#include "command.h"
#include "encoded_lines.h"
#include "parsed_number.h"
#include "picture_options.h"
#include "text_table.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace filigree::app {
namespace {

void addMethod(CLI::App& verb, jobs::RenderOptions& options) {
    verb.add_option("--method", options.method,
                    "none, texture, bitmask, gruen, micromap (the default), tree, indexed-tree, dag, sdag, "
                    "vq2, vq4, vq2+ or vq4+; hardware: micromaps of the Vulkan device itself")
        ->type_name("NAME");
    const auto setStates = [&options](const std::string& text) {
        options.states = parsedNumber<unsigned>(text, "--states", text);
        options.statesGiven = true;
    };
    verb.add_option_function<std::string>(
            "--states", setStates, "4, the default: unknown states ask the texture; 2: their side decides")
        ->type_name("2|4");
    const auto setLevel = [&options](const std::string& text) {
        if (text != "auto") options.level = parsedNumber<unsigned>(text, "--level", text);
        options.levelGiven = true;
    };
    verb.add_option_function<std::string>("--level", setLevel,
                                          "Bake at this level, or auto: the highest useful one per triangle, "
                                          "at most 8; without, the file's "
                                          "own micromaps, or auto up to 6 where it has none")
        ->type_name("0..12|auto");
}

void addPicture(CLI::App& verb, jobs::RenderOptions& options) {
    verb.add_option("--integrator", options.integrator, "primary, shadow, ao (the default) or path")
        ->type_name("NAME");
    addSizeOption(verb, options.width, options.height, "960x540");
    verb.add_option("--spp", options.spp, "Samples a pixel; default 16")->type_name("N");
    verb.add_option("--seed", options.seed, "Of the random numbers; default 1")->type_name("N");
    addCameraOption(verb, options.camera, "the file's first, or a view of the scene");
    verb.add_option("--bounces", options.bounces, "Of a path; default 3")->type_name("N");
    verb.add_flag("--defer", options.defer,
                  "Shadow and AO rays ask the texture only when no known state stops them");
    verb.add_flag("--two-state-shadows", options.twoStateShadows,
                  "Shadow and AO rays take the side of unknown states");
}

void addBackend(CLI::App& verb, jobs::RenderOptions& options) {
    verb.add_option("--backend", options.backend, "cpu (the default), or vulkan: a Vulkan device")
        ->type_name("NAME");
    verb.add_option("--device", options.device,
                    "The Vulkan device, by number or part of its name; by default the best")
        ->type_name("NAME|N");
    verb.add_option(
            "--path", options.path,
            "How the device traces: query (the default where it can), or pipeline, ray-tracing shaders")
        ->type_name("NAME");
    verb.add_option("--build", options.build,
                    "With --method hardware: fast-trace (the default) or fast-build")
        ->type_name("NAME");
}

void addCosts(CLI::App& verb, jobs::RenderOptions& options) {
    verb.add_option("--heatmap", options.heatmap, "Draw what each pixel cost to this PNG")->type_name("FILE");
    const auto setHeat = [&options](const std::string& text) {
        if (text != "tests" && text != "bits") throw CLI::ConversionError(text, "--heatmap-of");
        options.heatmapOf = text == "bits" ? jobs::HeatmapOf::bits : jobs::HeatmapOf::tests;
    };
    verb.add_option_function<std::string>("--heatmap-of", setHeat,
                                          "Alpha tests (the default), or bits that lookups read, on the CPU")
        ->type_name("tests|bits");
    verb.add_option("--triptych", options.triptych,
                    "Draw the picture and the alpha tests without and with maps side by side to this PNG")
        ->type_name("FILE");
    verb.add_option("--html", options.page,
                    "A page with the picture, heat maps without and with maps, and tables")
        ->type_name("FILE");
    verb.add_option("--beside", options.beside,
                    "Other methods for the page to set beside this one, with commas between them")
        ->delimiter(',')
        ->type_name("NAMES");
    verb.add_option("--preview", options.previewSeconds,
                    "Write the picture so far about every so many seconds, between samples")
        ->type_name("SECONDS");
}

std::string comparison(const jobs::RenderSummary& s) {
    const auto before = static_cast<double>(s.triptych->textureFetches);
    const auto after = static_cast<double>(s.counters.total().textureFetches);
    std::string text = before > 0 ? fmt::format("{} of the texture's alpha tests gone, ",
                                                report::formatShare(1 - after / before))
                                  : std::string("no alpha tests at all, ");
    if (s.triptych->identical) return text + "the picture is the same to the bit";
    return text + fmt::format("the picture differs: PSNR {:.2f} dB", s.triptych->psnr);
}

std::string gridsText(const jobs::RenderedGrids& grids) {
    return fmt::format("{}, {} triangles in {}: {:.3f} bytes each", grids.codec,
                       report::formatCount(grids.triangles), bytesText(grids.bytes),
                       static_cast<double>(grids.bytes) / static_cast<double>(grids.triangles));
}

void printRendered(const jobs::RenderSummary& s) {
    std::string method = s.method;
    if (s.states) method += fmt::format(", {} states", *s.states);
    if (s.hasLevels) method += s.level ? fmt::format(", level {}", *s.level) : ", levels differ";
    std::vector<std::pair<std::string, std::string>> lines{
        {"method", method},
        {"picture", fmt::format("{}, {} x {}, {} samples a pixel", s.integrator, s.width, s.height, s.spp)},
        {"rays", fmt::format("{:.2f} million a second, {} in {:.2f} s", s.mraysPerSecond(),
                             report::formatCount(s.counters.total().rays), s.seconds)}};
    if (!s.device.empty())
        lines.emplace_back("device", fmt::format("{}, {}, {}", s.device, s.driver, s.path));
    if (s.triptych) lines.emplace_back("saved", comparison(s));
    if (s.grids) lines.emplace_back("grids", gridsText(*s.grids));
    lines.emplace_back(
        "bytes", fmt::format("opacity {}, alpha textures {}, geometry {}, BVH {}", bytesText(s.opacityBytes),
                             bytesText(s.textureBytes), bytesText(s.geometryBytes), bytesText(s.bvhBytes)));
    lines.emplace_back("seconds", fmt::format("{:.2f} to the first sample, in all {:.2f}",
                                              s.firstSampleSeconds, s.totalSeconds));
    lines.emplace_back("memory", bytesText(s.peakBytes));
    printPairs(lines);
    fmt::print("\n");
    printTable(jobs::rayTable(s));
}

}  // namespace

void addRender(CLI::App& app, Commands& commands) {
    Command command(app, "render", "Render a scene with any way to test its alpha, and count the tests",
                    "filigree render forest.glb -o forest.png --method sdag --triptych tests.png");
    const auto options = std::make_shared<jobs::RenderOptions>();
    auto& verb = command.options();
    verb.add_option("input", options->input, "The scene, or compressed grids (.fil)")
        ->required()
        ->type_name("IN");
    verb.add_option("--scene", options->scene,
                    "Masked and blended triangles of this scene stand among the grids")
        ->type_name("FILE");
    verb.add_option("-o,--output", options->output, "The picture (.png)")->required()->type_name("OUT");
    addMethod(verb, *options);
    addPicture(verb, *options);
    addBackend(verb, *options);
    addCosts(verb, *options);
    command.onRun([command, options] {
        auto progress = command.progress();
        return command.finish(jobs::render(*options, *command.executor(), progress), printRendered);
    });
    commands.push_back(command);
}

}  // namespace filigree::app
