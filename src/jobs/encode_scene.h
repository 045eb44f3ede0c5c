// The maps of a scene in an encoding, whatever it asks for.
#pragma once

#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/encoding/encode.h"
#include "filigree/encoding/encoded_set.h"
#include "filigree/jobs/bake.h"
#include "filigree/jobs/encoded_size.h"
#include "filigree/scene/scene.h"

#include "jobs/scene_maps.h"

#include <string>
#include <string_view>
#include <vector>

namespace filigree::jobs {

// The encoding of that name, or ErrorKind::usage with all names and the option that gave it.
Result<encoding::Encoding> findEncoding(const std::string& name, std::string_view option = "--encoding");

// How to bake for `encoding`, whose sets shall have `parameters.states` in the end.
BakeParameters parametersFor(encoding::Encoding encoding, BakeParameters parameters);

// Encodes maps that were baked from `scene` in `format`. 2-state gruen masks of 4-state maps are conservative
// (docs/spec/gruen.md). Encoding::bitmask takes the alpha textures of the groups, one for each, instead of
// the maps. `aggregates` as in encoding::EncodeOptions.
Result<encoding::EncodedSet> encodeMaps(const scene::Scene& scene, const SceneMaps& maps,
                                        encoding::Encoding encoding, micromap::Format format,
                                        const Executor& executor, bool aggregates = false);

// How encodeMaps encodes micromaps.
encoding::EncodeOptions encodeOptions(const SceneMaps& maps, micromap::Format format, bool aggregates);

// Triangles whose vertices have an alpha of their own, which no texture can hold.
uint64_t vertexAlphaTriangles(const SceneMaps& maps);

// The indices of all primitives, one after another.
std::vector<int32_t> allIndices(const SceneMaps& maps);

EncodedSize sizeOf(const encoding::EncodedView& set, std::optional<unsigned> level);

}  // namespace filigree::jobs
