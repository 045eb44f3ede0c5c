#include "jobs/encode_scene.h"

#include "filigree/encoding/bitmask.h"

#include <algorithm>
#include <cassert>

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

Result<encoding::EncodedSet> encodeTextures(const scene::Scene& scene, const SceneMaps& maps,
                                            micromap::Format format, const Executor& executor) {
    std::vector<image::AlphaTexture> textures;
    for (const MapGroup& group : maps.groups) {
        assert(group.source && group.test);
        textures.push_back(textureOf(scene, *group.source));
    }
    std::vector<encoding::BitmaskSource> sources;
    for (size_t g = 0; g < textures.size(); ++g) sources.push_back({&textures[g], *maps.groups[g].test});
    return encoding::encodeBitmasks(sources, format, executor);
}

}  // namespace

Result<encoding::Encoding> findEncoding(const std::string& name, std::string_view option) {
    if (const auto found = encoding::encodingNamed(name)) return *found;
    std::string names;
    for (unsigned k = 0; k < encoding::encodingCount; ++k) {
        if (k > 0) names += ", ";
        names += encoding::nameOf(static_cast<encoding::Encoding>(k));
    }
    return Error{ErrorKind::usage, fmt::format("{} {}: choose one of {}", option, name, names)};
}

BakeParameters parametersFor(encoding::Encoding encoding, BakeParameters parameters) {
    // Its 1-bit masks say what may be opaque: a 2-state bake no longer knows.
    if (encoding == encoding::Encoding::gruen) parameters.states = 4;
    // It needs the groups alone, and they are cheapest at level 0.
    if (encoding == encoding::Encoding::bitmask) parameters.level = 0;
    return parameters;
}

Result<encoding::EncodedSet> encodeMaps(const scene::Scene& scene, const SceneMaps& maps,
                                        encoding::Encoding encoding, micromap::Format format,
                                        const Executor& executor, bool aggregates) {
    auto set = encoding == encoding::Encoding::bitmask
                   ? encodeTextures(scene, maps, format, executor)
                   : encoding::encode(encoding, maps.views(), format, encodeOptions(maps, format, aggregates),
                                      executor);
    if (!set) return set.error().within(std::string(encoding::nameOf(encoding)));
    return set;
}

encoding::EncodeOptions encodeOptions(const SceneMaps& maps, micromap::Format format, bool aggregates) {
    encoding::EncodeOptions options;
    options.aggregates = aggregates;
    options.maybeOpaque = maps.format == micromap::Format::fourState && format == micromap::Format::twoState;
    return options;
}

uint64_t vertexAlphaTriangles(const SceneMaps& maps) {
    uint64_t count = 0;
    for (const MapPrimitive& p : maps.primitives) {
        for (size_t t = 0; t < p.primitive->triangleCount(); ++t) {
            const auto alpha = p.primitive->uvTriangle(t).alpha;
            count += std::ranges::any_of(alpha, [](float value) { return value != 1; }) ? 1 : 0;
        }
    }
    return count;
}

std::vector<int32_t> allIndices(const SceneMaps& maps) {
    std::vector<int32_t> indices;
    indices.reserve(maps.maskedTriangles);
    for (const MapPrimitive& primitive : maps.primitives)
        indices.insert(indices.end(), primitive.indices.begin(), primitive.indices.end());
    return indices;
}

EncodedSize sizeOf(const encoding::EncodedView& set, std::optional<unsigned> level) {
    return {std::string(encoding::nameOf(set.encoding)),
            level,
            set.format == micromap::Format::twoState ? 2U : 4U,
            set.mapCount,
            set.payload.size(),
            set.descriptors.size()};
}

}  // namespace filigree::jobs
