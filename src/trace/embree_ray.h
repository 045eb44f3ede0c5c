// Rays as Embree takes them.
#pragma once

#include "filigree/core/vec3.h"

#include <embree3/rtcore.h>

namespace filigree::trace {

// The part of a ray from `near` to `far`, in lengths of `direction`.
inline RTCRay embreeRay(const Vec3& origin, const Vec3& direction, float near, float far) {
    RTCRay ray;
    ray.org_x = origin[0];
    ray.org_y = origin[1];
    ray.org_z = origin[2];
    ray.tnear = near;
    ray.dir_x = direction[0];
    ray.dir_y = direction[1];
    ray.dir_z = direction[2];
    ray.time = 0;
    ray.tfar = far;
    ray.mask = ~0u;
    ray.id = 0;
    ray.flags = 0;
    return ray;
}

}  // namespace filigree::trace
