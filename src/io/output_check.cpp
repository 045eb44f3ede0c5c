#include "io/output_check.h"

#include <algorithm>

#include <fmt/format.h>

namespace filigree::io {
namespace {

Status checkPrimitive(const OutputPrimitive& primitive, const MicromapOutput& output) {
    if (primitive.micromaps >= output.micromaps.size())
        return Error{ErrorKind::usage,
                     fmt::format("micromaps {} of {}", primitive.micromaps, output.micromaps.size())};
    const size_t records = output.micromaps[primitive.micromaps].set->records.size();
    for (size_t t = 0; t < primitive.indices.size(); ++t) {
        const int64_t index = primitive.indices[t];
        if (index < -4 || index >= static_cast<int64_t>(records))
            return Error{ErrorKind::usage, fmt::format("triangle {}: index {}, expected -4 to {}", t, index,
                                                       static_cast<int64_t>(records) - 1)};
    }
    const size_t vertices = primitive.vertexIndices.size();
    if (vertices == 0 || vertices == 3 * primitive.indices.size()) return {};
    return Error{ErrorKind::usage,
                 fmt::format("{} vertex indices for {} triangles", vertices, primitive.indices.size())};
}

}  // namespace

Status checkOutput(const MicromapOutput& output) {
    for (size_t k = 0; k < output.micromaps.size(); ++k) {
        const micromap::FlatSet* set = output.micromaps[k].set;
        if (set == nullptr || set->records.empty())
            return Error{ErrorKind::usage, fmt::format("micromaps {}: no record, expected at least one", k)};
    }
    for (const OutputPrimitive& primitive : output.primitives) {
        if (const Status status = checkPrimitive(primitive, output); !status)
            return status.error().within(
                fmt::format("primitive {} of mesh {}", primitive.primitive, primitive.mesh));
    }
    return {};
}

}  // namespace filigree::io
