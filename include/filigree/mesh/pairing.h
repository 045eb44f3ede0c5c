// Pairs of triangles that share an edge: what a square of opacity stands for (Fenney and Ozkan 2023, section
// 3).
#pragma once

#include "filigree/core/api.h"
#include "filigree/mesh/uv_triangle.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace filigree::mesh {

// Triangles to pair. Vertices are one where their positions are equal, whatever their indices.
struct PairingInput {
    std::span<const std::array<float, 3>> positions;  // [vertex_count]
    std::span<const Uv> uvs;                          // [vertex_count], or empty
    std::span<const uint32_t> indices;                // [3 * triangle_count], each below vertex_count
};

// A triangle in a pair. order[0] is its vertex opposite the shared edge, order[1] and order[2] the ends of
// the edge; each 0..2.
struct PairedTriangle {
    uint32_t triangle = 0;
    std::array<uint8_t, 3> order{0, 1, 2};
    bool operator==(const PairedTriangle&) const = default;
};

// Two triangles, or one that stays single. The shared edge runs from order[1] to order[2] of `first`, and
// from order[2] to order[1] of `second`. The order of `first` keeps its winding, that of `second` too unless
// the neighbours' windings disagree.
struct TrianglePair {
    PairedTriangle first;
    std::optional<PairedTriangle> second;  // a triangle of a higher number
    bool operator==(const TrianglePair&) const = default;
};

// `triangle` with its vertices in the pair's order.
template <class Vertex>
std::array<Vertex, 3> inOrder(const std::array<Vertex, 3>& vertices, const PairedTriangle& paired) {
    return {vertices[paired.order[0]], vertices[paired.order[1]], vertices[paired.order[2]]};
}

// Pairs the triangles over shared edges, each triangle once, by rising number of `first`. No pairing has
// fewer single triangles; among those none has more pairs whose texture coordinates go on over the edge;
// among those the boxes around the pairs are smallest, each measured against those of its two triangles in
// steps of 1/255 (maximum weight matching, Edmonds 1965). Edges without length or with a coordinate that is
// not finite are passed over. Where more than eight triangles meet in one edge, each may pair with the eight
// next ones there alone. Same input, same pairs.
FILIGREE_API std::vector<TrianglePair> pairTriangles(const PairingInput& input);

}  // namespace filigree::mesh
