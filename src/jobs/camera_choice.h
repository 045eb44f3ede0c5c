// The camera that a command line asks for.
#pragma once

#include "filigree/core/result.h"
#include "filigree/jobs/render.h"
#include "filigree/scene/scene.h"
#include "filigree/trace/world.h"

namespace filigree::jobs {

// For a picture `aspect` times as wide as high. ErrorKind::usage for a camera that the scene does not have,
// and for one that looks nowhere. The picture is `aspect` times as wide as high.
Result<scene::Camera> cameraFor(const CameraChoice& choice, const scene::Scene& scene,
                                const trace::World& world, float aspect = 16.0F / 9);

}  // namespace filigree::jobs
