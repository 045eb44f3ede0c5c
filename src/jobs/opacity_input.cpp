#include "jobs/opacity_input.h"

#include "jobs/encode_scene.h"

#include <algorithm>
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

Result<encoding::EncodedSet> encodeFor(Method method, unsigned states, const scene::Scene& scene,
                                       const SceneMaps& maps, const Executor& executor) {
    const auto encoding = trace::encodingOf(method);
    if (!encoding) return encoding::EncodedSet{};
    const auto format = states == 2 ? micromap::Format::twoState : micromap::Format::fourState;
    return encodeMaps(scene, maps, *encoding, format, executor);
}

}  // namespace

std::vector<trace::SurfaceMaps> surfaceMaps(const SceneMaps& maps, const trace::World& world, Method method) {
    const bool textures = method == Method::bitmask;
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

std::vector<trace::SurfaceSquares> surfaceSquares(const SceneSquares& squares, const trace::World& world) {
    std::unordered_map<const scene::Primitive*, trace::SurfaceSquares> found;
    size_t first = 0;
    for (const scene::Primitive* primitive : squares.primitives) {
        const size_t count = primitive->triangleCount();
        found.emplace(primitive, trace::SurfaceSquares{std::span(squares.indices).subspan(first, count),
                                                       std::span(squares.places).subspan(first, count)});
        first += count;
    }
    std::vector<trace::SurfaceSquares> surfaces(world.surfaceCount());
    for (size_t k = 0; k < surfaces.size(); ++k) {
        const auto at = found.find(&world.primitive(k));
        if (at != found.end()) surfaces[k] = at->second;
    }
    return surfaces;
}

Result<Method> findMethod(const std::string& name, std::string_view option) {
    if (const auto found = trace::methodNamed(name)) return *found;
    return Error{ErrorKind::usage, fmt::format("{} {}: choose one of {}", option, name, methodNames())};
}

bool readsMaps(Method method) {
    return trace::encodingOf(method).has_value();
}
bool readsSquares(Method method) {
    return trace::squareFormatOf(method).has_value();
}
bool hasStates(Method method) {
    return readsMaps(method) || readsSquares(method);
}
bool hasLevels(Method method) {
    return readsMaps(method) && method != Method::bitmask;
}

Result<OpacityInput> makeOpacity(Method method, unsigned states, const scene::Scene& scene,
                                 const SceneMaps& maps, const trace::World& world, const Executor& executor) {
    auto set = encodeFor(method, states, scene, maps, executor);
    if (!set) return set.error();
    OpacityInput input;
    input.set = std::move(*set);
    auto opacity =
        trace::Opacity::make(method, states, world, viewOf(input.set), surfaceMaps(maps, world, method));
    if (!opacity) return opacity.error();
    input.opacity.emplace(std::move(*opacity));
    return input;
}

Result<OpacityInput> makeSquareOpacity(Method method, unsigned states, const scene::Scene& scene,
                                       const BakeParameters& parameters, const trace::World& world,
                                       const Executor& executor, ProgressSink& progress) {
    assert(readsSquares(method));
    auto squares = encodeSquares(scene, pairGroups(scene, parameters), *trace::squareFormatOf(method),
                                 executor, progress);
    if (!squares) return squares.error();
    OpacityInput input;
    input.squares = std::move(*squares);
    const auto reader = quadmap::SquareReader::open(input.squares.format, input.squares.blocks);
    if (!reader) return reader.error();
    auto opacity = trace::Opacity::make(method, states, world, *reader, surfaceSquares(input.squares, world));
    if (!opacity) return opacity.error();
    input.opacity.emplace(std::move(*opacity));
    return input;
}

}  // namespace filigree::jobs
