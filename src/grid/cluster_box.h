// The box of a cluster as its leaf has it.
#pragma once

#include "filigree/core/box.h"
#include "filigree/grid/cluster.h"
#include "filigree/grid/encoded_grids.h"

namespace filigree::grid {

// A vertex of a decoded cluster on the lattice.
inline LatticePoint clusterPoint(const ClusterTriangles& cluster, size_t vertex) {
    return {cluster.vertices[0][vertex], cluster.vertices[1][vertex], cluster.vertices[2][vertex]};
}

// A point in the coordinates of leaf boxes: of the lattice, or world units with Codec::paper.
inline Vec3 leafCorner(const LatticePoint& p, Codec codec, const Lattice& lattice) {
    if (codec == Codec::paper) return lattice.positionOf(p);
    return {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
}

// Around all vertices.
inline Box clusterBox(const ClusterTriangles& cluster, Codec codec, const Lattice& lattice) {
    Box box;
    for (size_t k = 0; k < cluster.vertexCount; ++k)
        box.extend(leafCorner(clusterPoint(cluster, k), codec, lattice));
    return box;
}

}  // namespace filigree::grid
