#include "jobs/render_check.h"

#include "filigree/vulkan/picture.h"

#include "jobs/opacity_input.h"

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

using trace::Method;

Status checkFiles(const RenderOptions& options) {
    for (const auto& file : {options.output, options.heatmap, options.triptych}) {
        if (file.empty() || file.extension() == ".png") continue;
        return Error{
            ErrorKind::usage,
            fmt::format("{}: pictures are written as PNG; give a name that ends in .png", file.string())};
    }
    return {};
}

Status checkNumbers(const RenderOptions& options, Method method) {
    if (options.states != 2 && options.states != 4)
        return Error{ErrorKind::usage, fmt::format("--states {}: give 2 or 4", options.states)};
    if (options.level > micromap::maxLevel)
        return Error{ErrorKind::usage,
                     fmt::format("--level {}: the highest is {}", *options.level, micromap::maxLevel)};
    if (options.spp < 1) return Error{ErrorKind::usage, "--spp 0: give at least one sample a pixel"};
    if (!(options.previewSeconds >= 0)) return Error{ErrorKind::usage, "--preview: give seconds, 0 for none"};
    if (!options.triptych.empty() && !hasStates(method)) {
        return Error{ErrorKind::usage,
                     fmt::format("--triptych compares a method that has maps with texture; {} has none",
                                 nameOf(method))};
    }
    return {};
}

Status checkBeside(const RenderOptions& options) {
    if (options.beside.empty()) return {};
    if (options.page.empty()) return Error{ErrorKind::usage, "--beside: goes with --html"};
    if (options.backend != "cpu")
        return Error{ErrorKind::unsupported, "--beside: renders on the CPU; leave --backend out"};
    for (const std::string& name : options.beside) {
        if (const auto method = findMethod(name, "--beside"); !method) return method.error();
    }
    return {};
}

Status checkBackend(const RenderOptions& options) {
    if (options.backend != "cpu" && options.backend != "vulkan")
        return Error{ErrorKind::usage, fmt::format("--backend {}: choose cpu or vulkan", options.backend)};
    if (!options.build.empty() && options.method != hardwareMethod)
        return Error{ErrorKind::usage, "--build: goes with --method hardware"};
    if (!options.build.empty() && !vulkan::structureBuildNamed(options.build))
        return Error{ErrorKind::usage,
                     fmt::format("--build {}: choose fast-trace or fast-build", options.build)};
    if (options.backend == "cpu") {
        const std::string_view needs = options.method == hardwareMethod ? "--method hardware"
                                       : !options.device.empty()        ? "--device"
                                       : !options.path.empty()          ? "--path"
                                                                        : "";
        if (needs.empty()) return {};
        return Error{ErrorKind::usage, fmt::format("{}: goes with --backend vulkan", needs)};
    }
    if (options.defer)
        return Error{ErrorKind::unsupported,
                     "--defer: the backend vulkan defers no alpha tests; leave it out"};
    if (options.heatmap.empty() || options.heatmapOf == HeatmapOf::tests) return {};
    return Error{ErrorKind::unsupported, "--heatmap-of bits: the backend vulkan does not count bits"};
}

Result<Method> methodAsked(const RenderOptions& options) {
    if (options.method == hardwareMethod) return Method::micromap;
    return findMethod(options.method, "--method");
}

Result<trace::Integrator> integratorAsked(const RenderOptions& options) {
    if (const auto found = trace::integratorNamed(options.integrator)) return *found;
    return Error{ErrorKind::usage,
                 fmt::format("--integrator {}: choose one of primary, shadow, ao, path", options.integrator)};
}

}  // namespace

Result<RenderAsked> checked(const RenderOptions& options) {
    if (auto good = checkFiles(options); !good) return good.error();
    const auto method = methodAsked(options);
    if (!method) return method.error();
    const auto integrator = integratorAsked(options);
    if (!integrator) return integrator.error();
    if (auto good = checkNumbers(options, *method); !good) return good.error();
    if (auto good = checkBackend(options); !good) return good.error();
    if (auto good = checkBeside(options); !good) return good.error();
    if (auto good = trace::checkSize(options.width, options.height); !good) return good.error();
    return RenderAsked{*method, *integrator};
}

}  // namespace filigree::jobs
