#include "jobs/level_sweep.h"

#include "filigree/io/gltf.h"

#include <fmt/format.h>

namespace filigree::jobs {

Status checkLevels(std::span<const unsigned> levels) {
    if (levels.empty()) return Error{ErrorKind::usage, "--levels: give one or more"};
    for (const unsigned level : levels) {
        if (level > micromap::maxLevel)
            return Error{ErrorKind::usage,
                         fmt::format("--levels {}: the highest is {}", level, micromap::maxLevel)};
    }
    return {};
}

Result<scene::Scene> readUnbaked(const std::filesystem::path& input, const BakeParameters& parameters) {
    const auto document = io::GltfDocument::load(input);
    if (!document) return document.error();
    io::ReadOptions reading;
    reading.blendAlpha = parameters.includeBlend;
    reading.micromaps = false;
    return io::readScene(*document, reading);
}

Result<SceneMaps> bakeAt(scene::Scene& scene, const std::filesystem::path& input, BakeParameters parameters,
                         unsigned level, unsigned states, const Executor& executor, ProgressSink& progress) {
    parameters.level = level;
    parameters.states = states;
    auto maps = bakeMaps(scene, parameters, executor, progress);
    if (!maps) return maps.error().within(input.string());
    return maps;
}

}  // namespace filigree::jobs
