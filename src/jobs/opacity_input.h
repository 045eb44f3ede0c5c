// What the methods of the room `trace` read of a scene, baked and encoded as each wants it.
#pragma once

#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/encoding/encoded_set.h"
#include "filigree/jobs/bake.h"
#include "filigree/scene/scene.h"
#include "filigree/trace/opacity.h"
#include "filigree/trace/world.h"

#include "jobs/scene_maps.h"
#include "jobs/scene_squares.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace filigree::jobs {

// The method of that name. ErrorKind::usage, naming `option`, for one that is not known.
Result<trace::Method> findMethod(const std::string& name, std::string_view option);

// What a method takes: bitmasks and squares have no level, the texture neither level nor states.
bool hasLevels(trace::Method method);
bool hasStates(trace::Method method);
// Whether it reads what makeOpacity or what makeSquareOpacity makes; the texture takes either.
bool readsMaps(trace::Method method);
bool readsSquares(trace::Method method);

// What each surface of the world finds in the maps, or in the squares. They look into them.
std::vector<trace::SurfaceMaps> surfaceMaps(const SceneMaps& maps, const trace::World& world,
                                            trace::Method method);
std::vector<trace::SurfaceSquares> surfaceSquares(const SceneSquares& squares, const trace::World& world);

// A method with the data that it looks into.
struct OpacityInput {
    encoding::EncodedSet set;  // empty for methods that read none
    SceneSquares squares;      // likewise
    std::optional<trace::Opacity> opacity;
};

// Encodes `maps` of the scene behind `world` for `method`. Both must outlive the result, as must `scene`.
// `states` 2 keeps the sides of the maps' states only.
Result<OpacityInput> makeOpacity(trace::Method method, unsigned states, const scene::Scene& scene,
                                 const SceneMaps& maps, const trace::World& world, const Executor& executor);

// Makes squares of the scene behind `world` for a method that reads them. Of the parameters count the alpha
// tests' and which materials.
Result<OpacityInput> makeSquareOpacity(trace::Method method, unsigned states, const scene::Scene& scene,
                                       const BakeParameters& parameters, const trace::World& world,
                                       const Executor& executor, ProgressSink& progress);

}  // namespace filigree::jobs
