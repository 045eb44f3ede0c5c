// Rays by the ray-tracing pipeline.

layout(location = 0) rayPayloadEXT RayPayload payload;

void addCountsOf(uint kind, RayCounts counts) {
    countsOf[kind].candidates += counts.candidates;
    countsOf[kind].lookups += counts.lookups;
    countsOf[kind].fetches += counts.fetches;
}

// As in query.glsl.
bool meets(Ray ray, out Place place) {
    ++countsOf[ray.kind].rays;
    payload.kind = ray.kind;
    payload.seed = ray.seed;
    payload.counts = RayCounts(0u, 0u, 0u, 0u);
    payload.isHit = true;
    const uint skips = asksForAnyHit(ray.kind) ? gl_RayFlagsSkipClosestHitShaderEXT : gl_RayFlagsNoneEXT;
    traceRayEXT(structure, rayFlagsOf(ray) | skips, 0xffu, 0u, 0u, 0u, ray.origin, 0.0, ray.direction, ray.reach, 0);
    addCountsOf(ray.kind, payload.counts);
    place = payload.place;
    return payload.isHit;
}
