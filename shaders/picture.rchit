// The nearest hit of a ray of the pipeline.
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
hitAttributeEXT vec2 weights;

void main() {
    const uint number = uint(gl_InstanceCustomIndexEXT + gl_GeometryIndexEXT);
    payload.place = placeOf(surfaceOf(number), uint(gl_PrimitiveID), weights, gl_ObjectToWorldEXT, gl_WorldRayDirectionEXT);
}
