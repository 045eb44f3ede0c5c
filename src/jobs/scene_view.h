// A plain picture of a small scene: visible surfaces with alpha test, sun and shadow. It is here to show what
// the demo's scene looks like; it knows no micromaps and measures nothing.
#pragma once

#include "filigree/core/executor.h"
#include "filigree/scene/scene.h"

#include "jobs/canvas.h"

#include <cstdint>

namespace filigree::jobs {

// The scene from `camera`, four samples a pixel. Images must have their colour and, for MASK, their alpha
// decoded; others show as their material's factor. Same picture for any executor.
Canvas drawView(const scene::Scene& scene, const scene::Camera& camera, uint32_t width, uint32_t height,
                const Executor& executor);

}  // namespace filigree::jobs
