// Rays through the scene, and the places that they hit.
#define LIGHT(name, red, green, blue) const vec3 name = vec3(red, green, blue);
#define LIGHT_NUMBER(name, value) const float name = value;
#include "light_values.glsl"

const uint kindPrimary = 0u;
const uint kindShadow = 1u;
const uint kindAo = 2u;
const uint kindBounce = 3u;

const float farthest = 3.0e38;

// Shadow and AO rays ask whether anything is hit, the others for the nearest hit.
struct Ray {
    vec3 origin;
    vec3 direction;
    float reach;  // world units
    uint kind;
    uint seed;  // for stochastic transparency
};
bool asksForAnyHit(uint kind) {
    return kind == kindShadow || kind == kindAo;
}

// A place that a ray hit, as seen from where it came.
struct Place {
    vec3 point;
    vec3 normal;  // geometric, of length 1, towards the ray's origin
    vec3 albedo;
};

vec3 unit(vec3 v) {
    return v * (1.0 / sqrt(dot(v, v)));
}

// The nearest texel: the pictures show alpha tests, not texture filters. Colours are in sRGB, as bytes; the table of
// their linear values lies behind that of alphas.
vec3 albedoOf(Surface s, uvec3 corners, vec2 weights) {
    const vec3 factor = vec3(real(s.at + 11u), real(s.at + 12u), real(s.at + 13u));
    const uint at = word(s.at + 14u);
    if (at == none) return factor;
    const uint sizes = word(s.at + 15u);
    const uvec2 size = uvec2(sizes & 0xffffu, sizes >> 16) + 1u;
    const uint wraps = word(s.at + 9u);
    const ivec2 texel = ivec2(clamp(floor(coordinatesAt(s, corners, weights) * vec2(size)), -1e9, 1e9));
    const uint x = wrapTexel(texel.x, size.x, wraps & 3u);
    const uint y = wrapTexel(texel.y, size.y, (wraps >> 2) & 3u);
    const uint rgba = word(at + y * size.x + x);
    const uint table = word(s.at + 10u) + 256u;
    return factor * vec3(real(table + (rgba & 255u)), real(table + ((rgba >> 8) & 255u)), real(table + ((rgba >> 16) & 255u)));
}

Place placeOf(Surface s, uint triangle, vec2 weights, mat4x3 transform, vec3 direction) {
    const uvec3 corners = cornersOf(s, triangle);
    const vec3 a = transform * vec4(positionOf(s, corners.x), 1.0);
    const vec3 e1 = transform * vec4(positionOf(s, corners.y), 1.0) - a;
    const vec3 e2 = transform * vec4(positionOf(s, corners.z), 1.0) - a;
    const vec3 across = cross(e1, e2);
    vec3 normal = dot(across, across) > 0.0 ? unit(across) : -direction;
    if (dot(normal, direction) > 0.0) normal = -normal;
    return Place(a + (e1 * weights.x + e2 * weights.y), normal, albedoOf(s, corners, weights));
}

bool twoStatesFor(uint kind) {
    return (flags & flagTwoStates) != 0u || (asksForAnyHit(kind) && (flags & flagTwoStateShadows) != 0u);
}

// Those of the device's own micromaps.
uint micromapFlagsOf(Ray ray) {
#ifdef MICROMAPS
    return twoStatesFor(ray.kind) ? gl_RayFlagsForceOpacityMicromap2StateEXT : gl_RayFlagsNoneEXT;
#else
    return gl_RayFlagsNoneEXT;
#endif
}

uint rayFlagsOf(Ray ray) {
    return micromapFlagsOf(ray) |
           ((flags & flagAllOpaque) != 0u ? gl_RayFlagsOpaqueEXT : gl_RayFlagsNoneEXT) |
           (asksForAnyHit(ray.kind) ? gl_RayFlagsTerminateOnFirstHitEXT : gl_RayFlagsNoneEXT);
}
