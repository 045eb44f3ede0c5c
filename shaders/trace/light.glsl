// Sky, sun and the integrators of the CPU backend (src/trace/integrate.cpp).

vec3 sky(vec3 direction) {
    const float share = clamp(direction.y, 0.0, 1.0);
    return haze * (1.0 - share) + zenith * share;
}

// About the axis n of length 1, with the density of a diffuse reflection (Malley's method).
vec3 cosineDirection(vec3 n, inout RandomStream random) {
    const float radius = sqrt(randomFloat(random));
    const float angle = 6.28318530717958647692 * randomFloat(random);
    // A frame without branches: Duff et al., "Building an Orthonormal Basis, Revisited", 2017.
    const float sign_ = (floatBitsToUint(n.z) >> 31) != 0u ? -1.0 : 1.0;
    const float a = -1.0 / (sign_ + n.z);
    const float b = n.x * n.y * a;
    const vec3 t = vec3(1.0 + sign_ * n.x * n.x * a, sign_ * b, -sign_ * n.x);
    const vec3 s = vec3(b, sign_ + n.y * n.y * a, -n.y);
    const float up = sqrt(max(0.0, 1.0 - radius * radius));
    return unit(n * up + (t * (radius * cos(angle)) + s * (radius * sin(angle))));
}

// One sample of one pixel on its way: what it has seen, and the place that the next ray starts at.
struct Walk {
    vec3 light;
    vec3 throughput;
    uint bounce;
    Place place;
};

vec3 towardsSun() {
    return unit(sunDirection);
}

Ray rayFrom(Place place, vec3 direction, float reach, uint kind, inout RandomStream random) {
    return Ray(place.point + place.normal * epsilon, direction, reach, kind, randomBits(random));
}

// What the sun gives, where it is seen; the paths go on from there.
void addSun(inout Walk walk, bool isLit) {
    const vec3 sun = isLit ? sunlight * dot(walk.place.normal, towardsSun()) : vec3(0.0);
    if (integrator == 1u) {
        walk.light = walk.place.albedo * (shade + sun);
    } else {
        walk.light += walk.throughput * sun;
    }
}

// The next ray of a path, if there is one.
bool bounceOn(inout Walk walk, inout RandomStream random, out Ray ray) {
    if (integrator != 3u || walk.bounce == bounces) return false;
    ++walk.bounce;
    const vec3 direction = cosineDirection(walk.place.normal, random);
    ray = rayFrom(walk.place, direction, farthest, kindBounce, random);
    return true;
}

// The next ray from a place that the camera or a path sees, if there is one.
bool leave(inout Walk walk, vec3 direction, inout RandomStream random, out Ray ray) {
    if (integrator == 0u) {
        walk.light = walk.place.albedo * (headlightLeast + headlightMore * abs(dot(walk.place.normal, direction)));
        return false;
    }
    if (integrator == 2u) {
        const vec3 around = cosineDirection(walk.place.normal, random);
        ray = rayFrom(walk.place, around, aoDistance, kindAo, random);
        return true;
    }
    walk.throughput *= walk.place.albedo;
    if (dot(walk.place.normal, towardsSun()) > 0.0) {
        ray = rayFrom(walk.place, towardsSun(), farthest, kindShadow, random);
        return true;
    }
    addSun(walk, false);
    return bounceOn(walk, random, ray);
}

// What follows a ray, if anything does; `hit` and `place` are what it met.
bool follow(inout Walk walk, bool hit, Place place, inout RandomStream random, inout Ray ray) {
    if (ray.kind == kindAo) {
        walk.light = vec3(hit ? 0.0 : openLight);
        return false;
    }
    if (ray.kind == kindShadow) {
        addSun(walk, !hit);
        return bounceOn(walk, random, ray);
    }
    if (!hit) {
        walk.light += walk.throughput * sky(ray.direction);
        return false;
    }
    walk.place = place;
    return leave(walk, ray.direction, random, ray);
}
