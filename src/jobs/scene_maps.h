// The micromaps of a whole scene as quadtrees, equal ones once, never flat.
#pragma once

#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/image/alpha_image.h"
#include "filigree/jobs/bake.h"
#include "filigree/micromap/quadtree.h"
#include "filigree/scene/scene.h"

#include "jobs/alpha_source.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace filigree::jobs {

// Primitives whose micromaps a bake writes as one list.
struct MapGroup {
    std::string name;
    std::optional<image::AlphaTest> test;  // what the maps were baked with; none where a file does not say
    std::optional<AlphaSource> source;     // where they were baked from here
};

// A primitive with micromaps, and the map of each of its triangles.
struct MapPrimitive {
    const scene::Primitive* primitive = nullptr;
    size_t group = 0;              // into SceneMaps::groups
    std::vector<int32_t> indices;  // [triangle_count], into SceneMaps::maps, or special (-1..-4)
};

struct SceneMaps {
    micromap::Format format = micromap::Format::fourState;
    std::optional<unsigned> level;  // of all maps; none where they differ
    micromap::QuadtreeList maps;    // distinct over the whole scene, in the order of first use
    std::vector<MapGroup> groups;
    std::vector<MapPrimitive> primitives;  // in scene order; they look into the scene
    uint64_t triangles = 0;                // of the whole scene
    uint64_t maskedTriangles = 0;          // of `primitives`
    std::vector<std::string> notes;

    [[nodiscard]] std::vector<micromap::QuadtreeView> views() const;
};

// Bakes as bakeScene does, without a budget and without rotation. The micromaps that the scene came with are
// dropped from it. Memory grows with the outlines of the maps, not with their micro-triangles.
Result<SceneMaps> bakeMaps(scene::Scene& scene, const BakeParameters& parameters, const Executor& executor,
                           ProgressSink& progress);

// The micromaps that the scene came with. Uniform ones become special indices; 2-state ones beside 4-state
// ones become 4-state.
SceneMaps carriedMaps(const scene::Scene& scene);

}  // namespace filigree::jobs
