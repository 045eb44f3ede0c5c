// Rays by ray queries.
#include "grids.glsl"
#include "grid_places.glsl"

layout(constant_id = 1) const bool hasGrids = false;

// False where nothing is hit. Gives the place that the nearest hit is at, where that was asked for. Decoders are compiled
// into each call of this, so there should be one.
bool meets(Ray ray, out Place place) {
    ++countsOf[ray.kind].rays;
    rayQueryEXT query;
    rayQueryInitializeEXT(query, structure, rayFlagsOf(ray), 0xffu, ray.origin, 0.0, ray.direction, ray.reach);
    GridRay gridRay_;
    if (hasGrids) gridRay_ = gridRay(ray.origin, ray.direction);
    GridHit gridHit;
    while (rayQueryProceedEXT(query)) {
        if (hasGrids && rayQueryGetIntersectionTypeEXT(query, false) == gl_RayQueryCandidateIntersectionAABBEXT) {
            const bool isFirst = rayQueryGetIntersectionTypeEXT(query, true) == gl_RayQueryCommittedIntersectionNoneEXT;
            gridHit.t = isFirst ? ray.reach : rayQueryGetIntersectionTEXT(query, true);
            const uint record = uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, false));
            if (meetsRecord(record, gridRay_, 0.0, asksForAnyHit(ray.kind), gridHit)) rayQueryGenerateIntersectionEXT(query, gridHit.t);
            continue;
        }
        const uint number = uint(rayQueryGetIntersectionInstanceCustomIndexEXT(query, false) +
                                 rayQueryGetIntersectionGeometryIndexEXT(query, false));
        if (accepts(surfaceOf(number), uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, false)),
                    uint(rayQueryGetIntersectionInstanceIdEXT(query, false)),
                    rayQueryGetIntersectionBarycentricsEXT(query, false), ray.seed, twoStatesFor(ray.kind),
                    countsOf[ray.kind])) {
            rayQueryConfirmIntersectionEXT(query);
        }
    }
    if (rayQueryGetIntersectionTypeEXT(query, true) == gl_RayQueryCommittedIntersectionNoneEXT) return false;
    if (asksForAnyHit(ray.kind)) return true;
    if (hasGrids && rayQueryGetIntersectionTypeEXT(query, true) == gl_RayQueryCommittedIntersectionGeneratedEXT) {
        place = placeOnGrid(gridHit, ray.origin, ray.direction);
        return true;
    }
    const uint number = uint(rayQueryGetIntersectionInstanceCustomIndexEXT(query, true) +
                             rayQueryGetIntersectionGeometryIndexEXT(query, true));
    place = placeOf(surfaceOf(number), uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, true)),
                    rayQueryGetIntersectionBarycentricsEXT(query, true),
                    rayQueryGetIntersectionObjectToWorldEXT(query, true), ray.direction);
    return true;
}
