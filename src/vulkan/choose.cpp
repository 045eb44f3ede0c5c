#include "filigree/vulkan/device.h"
#include "filigree/vulkan/picture.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace filigree::vulkan {
namespace {

std::string lowered(std::string_view text) {
    std::string low(text);
    std::ranges::transform(low, low.begin(), [](unsigned char c) { return std::tolower(c); });
    return low;
}

std::optional<size_t> deviceNumber(std::string_view text) {
    size_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return number;
}

std::string listOf(std::span<const DeviceFacts> devices) {
    std::string list;
    for (size_t k = 0; k < devices.size(); ++k)
        list += fmt::format("{}{} {}", k == 0 ? "" : ", ", k, devices[k].name);
    return list;
}

}  // namespace

Result<size_t> chooseDevice(std::span<const DeviceFacts> devices, std::string_view wanted) {
    if (devices.empty()) return Error{ErrorKind::unsupported, "no Vulkan device was found; install a driver"};
    if (wanted.empty()) {
        const auto rank = [](const DeviceFacts& facts) { return std::pair(!facts.tracesRays(), facts.kind); };
        return static_cast<size_t>(std::ranges::min_element(devices, {}, rank) - devices.begin());
    }
    const auto number = deviceNumber(wanted);
    if (number && *number < devices.size()) return *number;
    std::vector<size_t> named;
    for (size_t k = 0; k < devices.size(); ++k) {
        if (lowered(devices[k].name).find(lowered(wanted)) != std::string::npos) named.push_back(k);
    }
    if (named.size() == 1) return named[0];
    return Error{ErrorKind::unsupported,
                 fmt::format("device '{}': {} of that name; choose one of {}", wanted,
                             named.empty() ? "there is none" : "there are several", listOf(devices))};
}

std::string_view nameOf(RayPath path) {
    return path == RayPath::query ? "query" : "pipeline";
}

std::string_view nameOf(StructureBuild build) {
    return build == StructureBuild::fastTrace ? "fast-trace" : "fast-build";
}

std::optional<StructureBuild> structureBuildNamed(std::string_view name) {
    for (const StructureBuild build : {StructureBuild::fastTrace, StructureBuild::fastBuild}) {
        if (name == nameOf(build)) return build;
    }
    return std::nullopt;
}

Result<RayPath> chooseRayPath(const DeviceFacts& facts, std::string_view wanted) {
    if (!wanted.empty() && wanted != "query" && wanted != "pipeline")
        return Error{ErrorKind::usage, fmt::format("--path {}: choose query or pipeline", wanted)};
    if (wanted.empty() && facts.tracesRays()) return facts.rayQuery ? RayPath::query : RayPath::pipeline;
    if (wanted == "query" && facts.rayQuery) return RayPath::query;
    if (wanted == "pipeline" && facts.rayPipeline) return RayPath::pipeline;
    const std::string_view lacks = wanted == "query" ? "ray queries (VK_KHR_ray_query)"
                                   : wanted == "pipeline"
                                       ? "ray-tracing pipelines (VK_KHR_ray_tracing_pipeline)"
                                       : "ray queries and no ray-tracing pipelines";
    return Error{ErrorKind::unsupported, fmt::format("{} ({}) has no {}", facts.name, facts.driver, lacks)};
}

}  // namespace filigree::vulkan
