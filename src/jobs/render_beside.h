// The same picture once more by other methods, to set beside the first.
#pragma once

#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/jobs/bake.h"
#include "filigree/scene/scene.h"
#include "filigree/trace/opacity.h"
#include "filigree/trace/render.h"

#include "jobs/opacity_input.h"
#include "jobs/scene_maps.h"

#include <cstdint>
#include <optional>
#include <string>

namespace filigree::jobs {

// What a method made of a picture.
struct MethodFilm {
    std::string method;
    std::optional<unsigned> states;  // none where it has none
    double seconds = 0;              // of tracing alone
    uint64_t opacityBytes = 0;
    trace::Film film;
};

// Renders what a first method has rendered, on the CPU.
class BesideRenderer {
  public:
    // `maps` are those of the first method, with levels; null: it has none. All must outlive this.
    BesideRenderer(scene::Scene& scene, const trace::World& world, const trace::RenderSettings& settings,
                   unsigned samples, const BakeParameters& parameters, const SceneMaps* maps,
                   const Executor& executor, ProgressSink& progress)
        : scene_(scene),
          world_(world),
          settings_(settings),
          samples_(samples),
          parameters_(parameters),
          maps_(maps),
          executor_(executor),
          progress_(progress) {}

    Result<MethodFilm> render(trace::Method method);

  private:
    Result<OpacityInput> prepare(trace::Method method);
    Result<const SceneMaps*> mapsFor(trace::Method method);
    Result<const SceneMaps*> baked(std::optional<SceneMaps>& into, const BakeParameters& parameters);

    scene::Scene& scene_;
    const trace::World& world_;
    const trace::RenderSettings& settings_;
    const unsigned samples_;
    const BakeParameters& parameters_;
    const SceneMaps* const maps_;
    const Executor& executor_;
    ProgressSink& progress_;
    std::optional<SceneMaps> levelMaps_;    // where the first method's do not serve
    std::optional<SceneMaps> textureMaps_;  // of bitmasks
    std::optional<SceneMaps> sideMaps_;     // of masks, which know sides alone
};

}  // namespace filigree::jobs
