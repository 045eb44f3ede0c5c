// Where alpha tests happen.
#pragma once

#include "filigree/scene/scene.h"
#include "filigree/trace/world.h"

namespace filigree::jobs {

// A camera from which primary rays meet many candidate hits: the best of some that look at random triangles
// with holes, the same ones on every machine. trace::overview where the scene has no holes.
scene::Camera busyView(const scene::Scene& scene, const trace::World& world);

}  // namespace filigree::jobs
