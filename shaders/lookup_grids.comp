// One vertex of a record an invocation, to compare decoders with those of the CPU.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

layout(local_size_x = 64) in;

layout(set = 0, binding = 0) readonly buffer Records { uint recordWords[]; };
#define GRID_WORDS recordWords
#include "decode/lattice.glsl"
#include "decode/cluster.glsl"

struct Query {
    uint offset;  // of the record, in 8 bytes; the top bit marks a cluster
    uint column;  // of the vertex; of a cluster the triangle
    uint row;     // or the triangle's corner
};
layout(set = 0, binding = 1, std430) readonly buffer Queries { Query queries[]; };
layout(set = 0, binding = 2) writeonly buffer Found { uint found[]; };  // x, y, z and whether a quad has the diagonal bd
layout(push_constant) uniform Range {
    uint first;
    uint count;
};

void main() {
    if (gl_GlobalInvocationID.x >= count) return;
    const uint k = first + gl_GlobalInvocationID.x;
    const Query query = queries[k];
    ivec3 point;
    bool isBd = false;
    if ((query.offset & 0x80000000u) != 0u) {
        point = clusterCorner(clusterHead(2u * (query.offset & 0x7fffffffu)), query.column, query.row);
    } else {
        const LatticeTile tile = latticeTile(2u * query.offset);
        point = latticeVertex(tile, query.column, query.row);
        if (query.column < tile.quads.x && query.row < tile.quads.y) isBd = latticeDiagonal(tile, query.column, query.row);
    }
    found[4u * k] = uint(point.x);
    found[4u * k + 1u] = uint(point.y);
    found[4u * k + 2u] = uint(point.z);
    found[4u * k + 3u] = isBd ? 1u : 0u;
}
