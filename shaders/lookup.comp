// One lookup an invocation, to compare decoders with those of the CPU.
#version 460
#extension GL_GOOGLE_include_directive : require

layout(local_size_x = 64) in;

#include "decode/any.glsl"

struct Query {
    uint map;    // squares: twice the map, and 1 for the second half
    float u;
    float v;
};
layout(set = 0, binding = 2, std430) readonly buffer Queries { Query queries[]; };
layout(set = 0, binding = 3) writeonly buffer Found { uint found[]; };
layout(push_constant) uniform Range {
    uint first;
    uint count;
};

void main() {
    if (gl_GlobalInvocationID.x >= count) return;
    const uint k = first + gl_GlobalInvocationID.x;
    const Query query = queries[k];
#if ENCODING >= VQ2
    found[k] = regionAt(query.map >> 1, regionIn(query.map & 1u, query.u, query.v, squareSide));
#else
    found[k] = stateAt(query.map, query.u, query.v);
#endif
}
