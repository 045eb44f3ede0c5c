// Cameras that see a box.
#pragma once

#include "filigree/core/box.h"
#include "filigree/core/vec3.h"
#include "filigree/scene/camera_rays.h"
#include "filigree/scene/scene.h"

namespace filigree::trace {

using scene::CameraRays;

inline constexpr float usualFov = 0.8F;  // radians, vertical

// Looks along -`from`, of length 1, at all of the box, from as near as it fits.
scene::Camera cameraOutside(const Box& box, const Vec3& from, float aspect);

}  // namespace filigree::trace
