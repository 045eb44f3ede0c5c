// Clusters of up to 64 loose triangles, decoded one after the other. docs/spec/cluster.md; the plain decoder is
// src/grid/cluster_decode.cpp.
#ifndef FILIGREE_DECODE_CLUSTER
#define FILIGREE_DECODE_CLUSTER
#include "records.glsl"

// A header, and where the parts begin, in bits from the record's first.
struct ClusterHead {
    uint record;  // word
    uint first;   // loose triangle
    uint triangles;
    ivec3 origin;
    uvec3 width;
    uint tilted;
    ivec3 slope;  // 32nds, by axis
    uint indexWidth;
    uint right;
    uint left;
    uvec3 offsets;
    uint fresh;
    uint known;
};

ClusterHead clusterHead(uint record) {
    ClusterHead head;
    head.record = record;
    head.first = recordWord(record, 0u);
    const uvec3 words = uvec3(recordWord(record, 1u), recordWord(record, 2u), recordWord(record, 3u));
    const uint counts = recordWord(record, 4u);
    head.triangles = (counts & 63u) + 1u;
    head.origin = ivec3(words) & latticeMask;
    head.width = (words >> 24u) & 31u;
    head.tilted = (words.x >> 29) & 3u;
    head.slope = besides(head.tilted, signedBits(counts, 20, 6), signedBits(counts, 26, 6));
    const uint vertices = ((counts >> 6) & 255u) + 1u;
    head.indexWidth = uint(findMSB(vertices - 1u) + 1);
    head.right = 160u;
    head.left = head.right + head.triangles;
    head.offsets.x = head.left + head.triangles;
    head.offsets.y = head.offsets.x + vertices * head.width.x;
    head.offsets.z = head.offsets.y + vertices * head.width.y;
    head.fresh = head.offsets.z + vertices * head.width.z;
    head.known = head.fresh + head.triangles + 2u * (((counts >> 14) & 63u) + 1u);
    return head;
}

ivec3 clusterVertex(ClusterHead head, uint vertex) {
    const uvec3 at = head.offsets + vertex * head.width;
    const ivec3 offset = ivec3(recordBits(head.record, at.x, head.width.x), recordBits(head.record, at.y, head.width.y),
                               recordBits(head.record, at.z, head.width.z));
    const ivec3 slopes = head.slope * offset;
    const int tilt = (slopes.x + slopes.y + slopes.z + 16) >> 5;
    const ivec3 isTilted = ivec3(equal(uvec3(head.tilted), uvec3(0u, 1u, 2u)));
    return (head.origin + offset + isTilted * tilt) & latticeMask;
}

// What goes on from triangle to triangle: the next bits, vertices so far, and the stack of directed edges, whose ends
// are in the low and the high half. It never holds more than half of 64 triangles.
struct ClusterWalk {
    uint triangle;
    uint flag;
    uint known;
    uint vertices;
    uint stacked;
};
uint clusterStack[34];

ClusterWalk clusterWalk(ClusterHead head) {
    return ClusterWalk(0u, head.fresh, head.known, 0u, 0u);
}

uint nextIndex(ClusterHead head, inout ClusterWalk walk) {
    if (recordBits(head.record, walk.flag++, 1u) != 0u) return walk.vertices++;
    const uint index = recordBits(head.record, walk.known, head.indexWidth);
    walk.known += head.indexWidth;
    return index;
}

// The corners of the next triangle, as numbers of vertices.
uvec3 nextTriangle(ClusterHead head, inout ClusterWalk walk) {
    uvec3 corners;
    if (walk.stacked == 0u) {
        corners.x = nextIndex(head, walk);
        corners.y = nextIndex(head, walk);
    } else {
        const uint edge = clusterStack[--walk.stacked];
        corners.xy = uvec2(edge & 0xffffu, edge >> 16);
    }
    corners.z = nextIndex(head, walk);
    if (recordBits(head.record, head.left + walk.triangle, 1u) != 0u) clusterStack[walk.stacked++] = corners.x | (corners.z << 16);
    if (recordBits(head.record, head.right + walk.triangle, 1u) != 0u) clusterStack[walk.stacked++] = corners.z | (corners.y << 16);
    ++walk.triangle;
    return corners;
}

// One corner of one triangle: there is no way to it but past those before it.
ivec3 clusterCorner(ClusterHead head, uint triangle, uint corner) {
    ClusterWalk walk = clusterWalk(head);
    uvec3 corners = uvec3(0u);
    while (walk.triangle <= triangle) corners = nextTriangle(head, walk);
    return clusterVertex(head, corner == 0u ? corners.x : corner == 1u ? corners.y : corners.z);
}

#endif
