// Rays through the pixels of a picture.
#pragma once

#include "filigree/core/box.h"
#include "filigree/core/vec3.h"
#include "filigree/scene/scene.h"

#include <cstdint>

namespace filigree::trace {

class CameraRays {
  public:
    CameraRays(const scene::Camera& camera, uint32_t width, uint32_t height);

    [[nodiscard]] Vec3 origin() const { return origin_; }
    // The direction, of length 1, through (x, y) in pixels, y downwards.
    [[nodiscard]] Vec3 through(float x, float y) const;

  private:
    Vec3 origin_{};
    Vec3 corner_{};  // towards the picture's upper left
    Vec3 right_{};   // one pixel
    Vec3 down_{};
};

inline constexpr float usualFov = 0.8F;  // radians, vertical

// Looks along -`from`, of length 1, at all of the box, from as near as it fits.
scene::Camera cameraOutside(const Box& box, const Vec3& from, float aspect);

}  // namespace filigree::trace
