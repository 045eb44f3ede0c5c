#include "jobs/command_words.h"

#include <variant>

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

void addWords(std::vector<std::string>& words, const char* option, const std::string& value) {
    words.insert(words.end(), {option, value});
}

}  // namespace

std::vector<std::string> testWords(const BakeParameters& p) {
    const BakeParameters usual;
    std::vector<std::string> words;
    if (p.mips != usual.mips) addWords(words, "--mips", p.mips == allMips ? "all" : std::to_string(p.mips));
    if (p.guard != usual.guard) addWords(words, "--guard", fmt::format("{}", p.guard));
    if (p.cutoff) addWords(words, "--cutoff", fmt::format("{}", *p.cutoff));
    if (p.includeBlend) words.emplace_back("--include-blend");
    return words;
}

std::vector<std::string> bakeWords(const BakeParameters& p) {
    const BakeParameters usual;
    std::vector<std::string> words;
    if (p.states != usual.states) addWords(words, "--states", std::to_string(p.states));
    if (p.level) addWords(words, "--level", std::to_string(*p.level));
    if (p.maxLevel != usual.maxLevel) addWords(words, "--max-level", std::to_string(p.maxLevel));
    if (p.budget) addWords(words, "--budget", std::to_string(*p.budget));
    const std::vector<std::string> test = testWords(p);
    words.insert(words.end(), test.begin(), test.end());
    if (p.rotate) words.emplace_back("--rotate");
    return words;
}

std::string cameraWord(const CameraChoice& camera) {
    if (const auto* number = std::get_if<unsigned>(&camera)) return fmt::format("--camera={}", *number);
    const auto* own = std::get_if<OwnCamera>(&camera);
    if (own == nullptr) return "";
    return fmt::format("--camera={},{},{},{}", fmt::join(own->eye, ","), fmt::join(own->target, ","),
                       fmt::join(own->up, ","), own->fov);
}

std::string renderCommand(const RenderOptions& o) {
    const RenderOptions usual;
    std::vector<std::string> words{"filigree", "render", o.input.string(), "-o", o.output.string()};
    const auto add = [&](const char* option, const std::string& value) { addWords(words, option, value); };
    if (!o.scene.empty()) add("--scene", o.scene.string());
    if (o.method != usual.method) add("--method", o.method);
    if (o.statesGiven) add("--states", std::to_string(o.states));
    if (o.levelGiven) add("--level", o.level ? std::to_string(*o.level) : "auto");
    if (o.integrator != usual.integrator) add("--integrator", o.integrator);
    if (o.width != usual.width || o.height != usual.height)
        add("--size", fmt::format("{}x{}", o.width, o.height));
    if (o.spp != usual.spp) add("--spp", std::to_string(o.spp));
    if (o.seed != usual.seed) add("--seed", std::to_string(o.seed));
    if (const std::string camera = cameraWord(o.camera); !camera.empty()) words.push_back(camera);
    if (o.bounces != usual.bounces) add("--bounces", std::to_string(o.bounces));
    if (o.defer) words.emplace_back("--defer");
    if (o.twoStateShadows) words.emplace_back("--two-state-shadows");
    if (o.backend != usual.backend) add("--backend", o.backend);
    if (!o.device.empty()) add("--device", o.device);
    if (!o.heatmap.empty()) add("--heatmap", o.heatmap.string());
    if (o.heatmapOf == HeatmapOf::bits) add("--heatmap-of", "bits");
    if (!o.triptych.empty()) add("--triptych", o.triptych.string());
    if (!o.beside.empty()) add("--beside", fmt::format("{}", fmt::join(o.beside, ",")));
    if (!o.page.empty()) add("--html", o.page.string());
    return shellCommand(words);
}

std::string gridsCommand(const GridsOptions& o) {
    std::vector<std::string> words{"filigree", "grids", o.input.string(), "-o", o.output.string()};
    const auto add = [&](const char* option, const std::string& value) { addWords(words, option, value); };
    if (o.codec != GridsOptions().codec) add("--codec", o.codec);
    if (o.precision.maxError)
        add("--max-error", fmt::format("{}{}", *o.precision.maxError, o.precision.isShare ? "d" : ""));
    if (o.precision.matchPaper) words.emplace_back("--match-paper");
    if (o.precision.lossless) words.emplace_back("--lossless");
    if (!o.displacement.empty()) add("--displacement", o.displacement);
    if (o.snap) words.emplace_back("--snap");
    if (o.cell) add("--cell", fmt::format("{}", *o.cell));
    if (o.heightScale) add("--height-scale", fmt::format("{}", *o.heightScale));
    if (!o.attributes) words.emplace_back("--no-attributes");
    if (o.zstd) words.emplace_back("--zstd");
    if (o.width != GridsOptions().width || o.height != GridsOptions().height)
        add("--size", fmt::format("{}x{}", o.width, o.height));
    if (!o.errorMap.empty()) add("--error-map", o.errorMap.string());
    if (!o.page.empty()) add("--html", o.page.string());
    return shellCommand(words);
}

std::string shellCommand(std::span<const std::string> words) {
    constexpr std::string_view plain =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._/=+:,@%";
    std::string command;
    for (const std::string& word : words) {
        if (!command.empty()) command += ' ';
        if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) {
            command += word;
            continue;
        }
        command += '\'';
        for (const char c : word) command += c == '\'' ? std::string("'\\''") : std::string(1, c);
        command += '\'';
    }
    return command;
}

}  // namespace filigree::jobs
