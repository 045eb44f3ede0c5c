// The picture in the making, and what its rays cost.

struct Pixel {
    float light[3];  // linear, of all samples
    uint hits;       // samples whose first ray met the scene
};
layout(set = 0, binding = 2, std430) buffer Film { Pixel pixels[]; };
layout(set = 0, binding = 3, std430) buffer Counts { uint counts[]; };  // 16 a pixel
layout(set = 0, binding = 5) uniform accelerationStructureEXT structure;

RayCounts countsOf[4];  // by kind of rays, of this sample of the pixel

void clearCounts() {
    for (uint kind = 0u; kind < 4u; ++kind) countsOf[kind] = RayCounts(0u, 0u, 0u, 0u);
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
