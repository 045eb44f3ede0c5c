// What the intersection shader tells the closest-hit shader: of a GridHit.
struct GridAttributes {
    vec3 normal;
    vec2 weights;
    uint place;
};
hitAttributeEXT GridAttributes attributes;
