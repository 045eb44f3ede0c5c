// A scene in one buffer of words, as src/vulkan/scene_words.cpp lays it out.

layout(buffer_reference, std430, buffer_reference_align = 4) readonly buffer SceneWords { uint words[]; };

layout(push_constant) uniform Settings {
    uvec2 scene;       // address of the words
    float origin[3];   // of the camera
    float corner[3];   // towards the picture's upper left
    float right[3];    // one pixel
    float down[3];     // one pixel
    uint width;        // pixels
    uint firstRow;     // of the rows that are rendered now
    uint rows;
    uint sample_;
    uint seed;
    uint integrator;   // 0 primary, 1 shadow, 2 ao, 3 path
    uint bounces;
    uint flags;        // below
    float epsilon;     // world units, how far rays start off a surface
    float aoDistance;  // world units
    uint grids;        // the word that compressed grids begin at
};
const uint flagAllOpaque = 1u;        // every candidate is a hit
const uint flagTwoStates = 2u;        // the side of a state decides
const uint flagTwoStateShadows = 4u;  // so for shadow and AO rays
const uint flagCounts = 8u;

uint word(uint at) {
    return SceneWords(scene).words[at];
}
float real(uint at) {
    return uintBitsToFloat(word(at));
}

const uint none = ~0u;
const uint surfaceWords = 16u;

// A surface, and where its words begin: a SurfaceWords of src/vulkan/scene_words.h.
struct Surface {
    uint number;
    uint at;
};
Surface surfaceOf(uint number) {
    return Surface(number, surfaceWords * number);
}
bool isBlended(Surface s) {
    return word(s.at) == 2u;
}
bool hasVertexAlphas(Surface s) {
    return word(s.at + 4u) != none;
}

uvec3 cornersOf(Surface s, uint triangle) {
    const uint at = word(s.at + 1u) + 3u * triangle;
    return uvec3(word(at), word(at + 1u), word(at + 2u));
}
vec3 positionOf(Surface s, uint vertex) {
    const uint at = word(s.at + 2u) + 3u * vertex;
    return vec3(real(at), real(at + 1u), real(at + 2u));
}
vec2 coordinatesOf(Surface s, uint vertex) {
    const uint at = word(s.at + 3u) + 2u * vertex;
    return vec2(real(at), real(at + 1u));
}

// Texture coordinates at weights u and v of vertices 1 and 2.
vec2 coordinatesAt(Surface s, uvec3 corners, vec2 weights) {
    const vec2 a = coordinatesOf(s, corners.x);
    const vec2 b = coordinatesOf(s, corners.y) - a;
    const vec2 c = coordinatesOf(s, corners.z) - a;
    return a + weights.x * b + weights.y * c;
}

// The texel that a coordinate reads on an axis: 0 repeat, 1 mirrored, 2 clamp.
uint wrapTexel(int coordinate, uint size, uint wrap) {
    const int length_ = int(size);
    if (wrap == 2u) return uint(clamp(coordinate, 0, length_ - 1));
    const int period = wrap == 0u ? length_ : 2 * length_;
    int at = coordinate % period;
    at = at < 0 ? at + period : at;
    return uint(at < length_ ? at : period - 1 - at);
}
