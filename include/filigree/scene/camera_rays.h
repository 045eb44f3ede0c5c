// Rays through the pixels of a picture.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/vec3.h"
#include "filigree/scene/scene.h"

#include <cstdint>

namespace filigree::scene {

// The rays of one camera through a picture of width x height pixels.
class FILIGREE_API CameraRays {
  public:
    CameraRays(const Camera& camera, uint32_t width, uint32_t height);

    [[nodiscard]] Vec3 origin() const { return origin_; }
    // The direction, of length 1, through (x, y) in pixels, y downwards.
    [[nodiscard]] Vec3 through(float x, float y) const {
        return normalised(plus(corner_, plus(times(right_, x), times(down_, y))));
    }

    // What through() is made of: towards the picture's upper left, and one pixel along each side.
    [[nodiscard]] Vec3 corner() const { return corner_; }
    [[nodiscard]] Vec3 right() const { return right_; }
    [[nodiscard]] Vec3 down() const { return down_; }

  private:
    Vec3 origin_{};
    Vec3 corner_{};
    Vec3 right_{};
    Vec3 down_{};
};

}  // namespace filigree::scene
