// Triangles to clusters, in one part of space.
#pragma once

#include "filigree/core/vec3.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace filigree::grid {

struct ClusterInput {
    std::span<const Vec3> positions;                     // of all vertices
    std::span<const std::array<uint32_t, 3>> triangles;  // equal positions have one vertex
    std::span<const uint32_t> part;                      // which of the triangles, neighbours near each other
    float grain = 0;                                     // world units: what is smaller costs nothing
};

// Triangles of one cluster, into ClusterInput::triangles.
using ClusterMembers = std::vector<uint32_t>;

// Grows clusters of up to maxClusterTriangles one after another. A cluster takes of the triangles that touch
// it the one that adds the fewest bits to its vertices. Where none touches it takes one that lies near, if
// that costs less than a record begun anew.
std::vector<ClusterMembers> growClusters(const ClusterInput& input);

// Puts the members of a cluster into an order of few roots (docs/spec/cluster.md), turning triangles.
void orderCluster(std::span<const std::array<uint32_t, 3>> triangles, ClusterMembers& members,
                  std::vector<uint8_t>& turns);

}  // namespace filigree::grid
