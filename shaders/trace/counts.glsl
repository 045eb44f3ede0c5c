// What rays cost.

// Of one kind of rays.
struct RayCounts {
    uint rays;
    uint candidates;
    uint lookups;
    uint fetches;
};
