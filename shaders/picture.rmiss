// A ray of the pipeline that hits nothing.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#extension GL_EXT_ray_tracing : require

#include "trace/counts.glsl"
#include "trace/scene.glsl"
#include "trace/rays.glsl"
#include "trace/payload.glsl"

layout(location = 0) rayPayloadInEXT RayPayload payload;

void main() {
    payload.isHit = false;
}
