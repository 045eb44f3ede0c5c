// What stands beside the micromaps of a scene in memory.
#pragma once

#include "filigree/scene/scene.h"

#include "jobs/scene_maps.h"

#include <cstdint>

namespace filigree::jobs {

// One byte for each texel of the distinct alpha images of the maps' primitives.
uint64_t textureBytes(const scene::Scene& scene, const SceneMaps& maps);

// Eight bytes, the texture coordinates, for each vertex that a triangle of the maps' primitives uses.
uint64_t vertexBytes(const SceneMaps& maps);

}  // namespace filigree::jobs
