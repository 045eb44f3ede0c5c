// The nearest hit of a ray of the pipeline, on compressed grids.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_ray_tracing : require

#include "trace/counts.glsl"
#include "trace/scene.glsl"
#include "trace/rays.glsl"
#include "trace/payload.glsl"
#include "trace/grids.glsl"
#include "trace/grid_places.glsl"
#include "trace/grid_attributes.glsl"

layout(location = 0) rayPayloadInEXT RayPayload payload;

void main() {
    const GridHit hit = GridHit(gl_HitTEXT, uint(gl_PrimitiveID), attributes.place, attributes.weights, attributes.normal);
    payload.place = placeOnGrid(hit, gl_WorldRayOriginEXT, gl_WorldRayDirectionEXT);
}
