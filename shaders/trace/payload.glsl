// What a ray of the pipeline takes along.
struct RayPayload {
    uint kind;
    uint seed;
    RayCounts counts;  // of this ray
    bool isHit;        // true until a ray misses
    Place place;       // of the nearest hit, where that is asked for
};
