#include "jobs/encode_scene.h"

#include "filigree/encoding/encode.h"

#include <fmt/format.h>

namespace filigree::jobs {

Result<encoding::Encoding> findEncoding(const std::string& name) {
    if (const auto found = encoding::encodingNamed(name)) return *found;
    std::string names;
    for (unsigned k = 0; k < encoding::encodingCount; ++k) {
        if (k > 0) names += ", ";
        names += encoding::nameOf(static_cast<encoding::Encoding>(k));
    }
    return Error{ErrorKind::usage, fmt::format("--encoding {}: choose one of {}", name, names)};
}

BakeParameters parametersFor(encoding::Encoding encoding, BakeParameters parameters) {
    // Its 1-bit masks say what may be opaque: a 2-state bake no longer knows.
    if (encoding == encoding::Encoding::gruen) parameters.states = 4;
    return parameters;
}

Result<encoding::EncodedSet> encodeMaps(const SceneMaps& maps, encoding::Encoding encoding,
                                        micromap::Format format, const Executor& executor) {
    encoding::EncodeOptions options;
    options.maybeOpaque = maps.format == micromap::Format::fourState && format == micromap::Format::twoState;
    auto set = encoding::encode(encoding, maps.views(), format, options, executor);
    if (!set) return set.error().within(std::string(encoding::nameOf(encoding)));
    return set;
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
