// One more sample of each pixel, by ray queries.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#extension GL_EXT_ray_query : require

layout(local_size_x = 8, local_size_y = 8) in;

#include "decode/any.glsl"

struct Pixel {
    float light[3];  // linear, of all samples
    uint hits;       // samples whose first ray met the scene
};
layout(set = 0, binding = 2, std430) buffer Film { Pixel pixels[]; };
layout(set = 0, binding = 3, std430) buffer Counts { uint counts[]; };  // 16 a pixel
// Of each surface where what its triangles say of their maps begins, here, or none; with a bitmask its texture, or none.
layout(set = 0, binding = 4) readonly buffer Maps { uint maps[]; };
layout(set = 0, binding = 5) uniform accelerationStructureEXT structure;

#include "trace/random.glsl"
#include "trace/scene.glsl"
#include "trace/alpha.glsl"
#include "trace/opacity.glsl"
#include "trace/rays.glsl"
#include "trace/light.glsl"

vec3 fromArray(float v[3]) {
    return vec3(v[0], v[1], v[2]);
}

void addCounts(uint pixel) {
    for (uint kind = 0u; kind < 4u; ++kind) {
        const uint at = 16u * pixel + 4u * kind;
        counts[at] += countsOf[kind].rays;
        counts[at + 1u] += countsOf[kind].candidates;
        counts[at + 2u] += countsOf[kind].lookups;
        counts[at + 3u] += countsOf[kind].fetches;
    }
}

void main() {
    const uvec2 at = gl_GlobalInvocationID.xy;
    if (at.x >= width || at.y >= rows) return;
    const uint pixel = at.y * width + at.x;
    for (uint kind = 0u; kind < 4u; ++kind) countsOf[kind] = RayCounts(0u, 0u, 0u, 0u);
    RandomStream random = randomStream(seed, (firstRow + at.y) * width + at.x, sample_);
    const float y = float(firstRow + at.y) + randomFloat(random);
    const float x = float(at.x) + randomFloat(random);
    const vec3 direction = unit(fromArray(corner) + (fromArray(right) * x + fromArray(down) * y));
    Ray ray = Ray(fromArray(origin), direction, farthest, kindPrimary, randomBits(random));
    Walk walk;
    walk.light = vec3(0.0);
    walk.throughput = vec3(1.0);
    walk.bounce = 0u;
    bool goesOn = true;
    while (goesOn) {
        Place place;
        const bool hit = meets(ray, place);
        if (ray.kind == kindPrimary && hit) ++pixels[pixel].hits;
        goesOn = follow(walk, hit, place, random, ray);
    }
    for (uint channel = 0u; channel < 3u; ++channel) pixels[pixel].light[channel] += walk.light[channel];
    if ((flags & flagCounts) != 0u) addCounts(pixel);
}
