#include "jobs/opacity_input.h"

#include "jobs/encode_scene.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <unordered_map>
#include <vector>

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

using trace::Method;

std::string methodNames() {
    std::string names;
    for (size_t k = 0; k < trace::methodCount; ++k)
        names += fmt::format("{}{}", k > 0 ? ", " : "", nameOf(static_cast<Method>(k)));
    return names;
}

// What each surface of the world finds in the maps.
std::vector<trace::SurfaceMaps> surfaceMaps(const SceneMaps& maps, const trace::World& world, bool textures) {
    std::unordered_map<const scene::Primitive*, const MapPrimitive*> found;
    for (const MapPrimitive& p : maps.primitives) found.emplace(p.primitive, &p);
    std::vector<trace::SurfaceMaps> surfaces(world.surfaceCount());
    for (size_t k = 0; k < surfaces.size(); ++k) {
        const auto at = found.find(&world.primitive(k));
        if (at == found.end()) continue;
        if (textures) {
            surfaces[k].texture = static_cast<uint32_t>(at->second->group);
        } else {
            surfaces[k].indices = at->second->indices;
        }
    }
    return surfaces;
}

Result<encoding::EncodedSet> encodeFor(Method method, unsigned states, const scene::Scene& scene,
                                       const SceneMaps& maps, const Executor& executor) {
    const auto encoding = trace::encodingOf(method);
    if (!encoding) return encoding::EncodedSet{};
    const auto format = states == 2 ? micromap::Format::twoState : micromap::Format::fourState;
    return encodeMaps(scene, maps, *encoding, format, executor);
}

}  // namespace

Result<Method> findMethod(const std::string& name, std::string_view option) {
    if (const auto found = trace::methodNamed(name)) return *found;
    constexpr std::array<std::string_view, 4> planned{"vq2", "vq4", "vq2+", "vq4+"};
    if (std::ranges::find(planned, name) != planned.end()) {
        return Error{ErrorKind::usage,
                     fmt::format("{} {} is not in this version; it has {}", option, name, methodNames())};
    }
    return Error{ErrorKind::usage, fmt::format("{} {}: choose one of {}", option, name, methodNames())};
}

bool hasStates(Method method) {
    return trace::encodingOf(method).has_value();
}
bool hasLevels(Method method) {
    return hasStates(method) && method != Method::bitmask;
}

Result<OpacityInput> makeOpacity(Method method, unsigned states, const scene::Scene& scene,
                                 const SceneMaps& maps, const trace::World& world, const Executor& executor) {
    auto set = encodeFor(method, states, scene, maps, executor);
    if (!set) return set.error();
    OpacityInput input;
    input.set = std::move(*set);
    auto opacity = trace::Opacity::make(method, states, world, viewOf(input.set),
                                        surfaceMaps(maps, world, method == Method::bitmask));
    if (!opacity) return opacity.error();
    input.opacity.emplace(std::move(*opacity));
    return input;
}

}  // namespace filigree::jobs
