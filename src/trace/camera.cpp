#include "trace/camera.h"

#include "filigree/trace/render.h"

#include <algorithm>
#include <cmath>

namespace filigree::trace {
namespace {

Vec3 axis(const scene::Camera& camera, size_t column) {
    const auto& m = camera.transform;
    const Vec3 v{m[4 * column], m[4 * column + 1], m[4 * column + 2]};
    return dot(v, v) > 0 ? normalised(v) : v;
}

}  // namespace

CameraRays::CameraRays(const scene::Camera& camera, uint32_t width, uint32_t height) {
    const auto& m = camera.transform;
    origin_ = {m[12], m[13], m[14]};
    const float halfHeight = std::tan(camera.verticalFov / 2);
    const float halfWidth = halfHeight * static_cast<float>(width) / static_cast<float>(height);
    right_ = times(axis(camera, 0), 2 * halfWidth / static_cast<float>(width));
    down_ = times(axis(camera, 1), -2 * halfHeight / static_cast<float>(height));
    corner_ = plus(times(axis(camera, 2), -1),
                   plus(times(axis(camera, 0), -halfWidth), times(axis(camera, 1), halfHeight)));
}

Vec3 CameraRays::through(float x, float y) const {
    return normalised(plus(corner_, plus(times(right_, x), times(down_, y))));
}

scene::Camera lookAt(const Vec3& eye, const Vec3& target, const Vec3& up, float fov) {
    const Vec3 towards = minus(target, eye);
    const Vec3 back = dot(towards, towards) > 0 ? times(normalised(towards), -1) : Vec3{0, 0, 1};
    Vec3 right = cross(up, back);
    if (!(dot(right, right) > 0))
        right = cross(std::fabs(back[0]) < 0.9F ? Vec3{1, 0, 0} : Vec3{0, 0, 1}, back);
    right = normalised(right);
    const Vec3 above = cross(back, right);
    scene::Camera camera;
    camera.verticalFov = fov;
    camera.transform = {right[0], right[1], right[2], 0, above[0], above[1], above[2], 0,
                        back[0],  back[1],  back[2],  0, eye[0],   eye[1],   eye[2],   1};
    return camera;
}

scene::Camera cameraOutside(const Box& box, const Vec3& from, float aspect) {
    const Vec3 centre = times(plus(box.low, box.high), 0.5F);
    const scene::Camera at = lookAt(plus(centre, from), centre, {0, 1, 0}, usualFov);
    const auto& m = at.transform;
    const Vec3 right{m[0], m[1], m[2]};
    const Vec3 above{m[4], m[5], m[6]};
    const float slope = std::tan(usualFov / 2);
    float distance = 1e-3F;
    for (unsigned k = 0; k < 8; ++k) {
        const Vec3 corner = minus(box.corner(k), centre);
        const float reach =
            std::max(std::fabs(dot(corner, right)) / (slope * aspect), std::fabs(dot(corner, above)) / slope);
        distance = std::max(distance, dot(corner, from) + reach);
    }
    return lookAt(plus(centre, times(from, distance)), centre, {0, 1, 0}, usualFov);
}

}  // namespace filigree::trace
