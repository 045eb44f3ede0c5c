#include "filigree/scene/camera_rays.h"

#include <cmath>

namespace filigree::scene {
namespace {

Vec3 cameraAxis(const Camera& camera, size_t column) {
    const auto& m = camera.transform;
    const Vec3 v{m[4 * column], m[4 * column + 1], m[4 * column + 2]};
    return dot(v, v) > 0 ? normalised(v) : v;
}

}  // namespace

CameraRays::CameraRays(const Camera& camera, uint32_t width, uint32_t height) {
    const auto& m = camera.transform;
    origin_ = {m[12], m[13], m[14]};
    const float halfHeight = std::tan(camera.verticalFov / 2);
    const float halfWidth = halfHeight * static_cast<float>(width) / static_cast<float>(height);
    right_ = times(cameraAxis(camera, 0), 2 * halfWidth / static_cast<float>(width));
    down_ = times(cameraAxis(camera, 1), -2 * halfHeight / static_cast<float>(height));
    corner_ = plus(times(cameraAxis(camera, 2), -1),
                   plus(times(cameraAxis(camera, 0), -halfWidth), times(cameraAxis(camera, 1), halfHeight)));
}

}  // namespace filigree::scene
