// One more sample of each pixel, by ray queries.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_ray_query : require
#ifdef MICROMAPS
#extension GL_EXT_opacity_micromap : require
#endif

layout(local_size_x = 8, local_size_y = 8) in;

#include "decode/any.glsl"
#include "trace/counts.glsl"
#include "trace/film.glsl"
#include "trace/random.glsl"
#include "trace/scene.glsl"
#include "trace/alpha.glsl"
#include "trace/opacity.glsl"
#include "trace/rays.glsl"
#include "trace/query.glsl"
#include "trace/light.glsl"
#include "trace/pixel.glsl"

void main() {
    const uvec2 at = gl_GlobalInvocationID.xy;
    if (at.x < width && at.y < rows) addSample(at);
}
