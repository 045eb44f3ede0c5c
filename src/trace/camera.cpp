#include "trace/camera.h"

#include "filigree/trace/render.h"

#include <algorithm>
#include <cmath>

namespace filigree::trace {
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
