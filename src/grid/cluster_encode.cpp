#include "filigree/core/bits.h"

#include "grid/cluster_layout.h"
#include "grid/cluster_tilt.h"

#include <algorithm>
#include <cassert>

namespace filigree::grid {
namespace {

using LocalTriangle = std::array<uint8_t, 3>;

// The record's triangles over its own vertices, those numbered as they come up.
struct LocalMesh {
    std::vector<LatticePoint> points;
    std::vector<LocalTriangle> triangles;
};

// Numbers points as they come up.
class PointNumbers {
  public:
    PointNumbers() { slots_.fill(0xff); }

    uint8_t numberOf(const LatticePoint& point, std::vector<LatticePoint>& points) {
        size_t at = hashOf(point) % slots_.size();
        while (slots_[at] != 0xff && points[slots_[at]] != point) at = (at + 1) % slots_.size();
        if (slots_[at] == 0xff) {
            slots_[at] = static_cast<uint8_t>(points.size());
            points.push_back(point);
        }
        return slots_[at];
    }

  private:
    static size_t hashOf(const LatticePoint& point) {
        uint64_t hash = 0;
        for (const int32_t x : point) hash = (hash + static_cast<uint32_t>(x)) * 0x9e3779b97f4a7c15;
        return hash >> 40;
    }

    std::array<uint8_t, 512> slots_;  // 0xff: free; there are at most maxClusterVertices points
};

LocalMesh localMesh(const GridMesh& mesh, uint32_t first, uint32_t count, const Lattice& lattice) {
    LocalMesh local;
    PointNumbers numbers;
    for (uint32_t t = first; t < first + count; ++t) {
        LocalTriangle triangle{};
        for (size_t k = 0; k < 3; ++k) {
            const Vec3& position = mesh.looseVertices[mesh.looseTriangles[t][k]];
            triangle[k] = numbers.numberOf(lattice.pointAt(position), local.points);
        }
        local.triangles.push_back(triangle);
    }
    return local;
}

// The bits that tell which triangles stand on which edges.
struct Tree {
    uint64_t right = 0;
    uint64_t left = 0;
    uint64_t root = 0;
};

// Takes for each triangle the last edge still open on which it can stand; edges opened after that one are
// given up.
Tree treeOf(std::span<const LocalTriangle> triangles) {
    Tree tree;
    struct OpenEdge {
        size_t triangle;
        bool left;
    };
    std::vector<OpenEdge> open;
    for (size_t t = 0; t < triangles.size(); ++t) {
        const auto standsOn = [&](const OpenEdge& edge) {
            const auto& [c0, c1, c2] = triangles[edge.triangle];
            return triangles[t][0] == (edge.left ? c0 : c2) && triangles[t][1] == (edge.left ? c2 : c1);
        };
        const auto found = std::find_if(open.rbegin(), open.rend(), standsOn);
        if (found == open.rend()) {
            tree.root |= uint64_t{1} << t;
            open.clear();
        } else {
            (found->left ? tree.left : tree.right) |= uint64_t{1} << found->triangle;
            open.erase(found.base() - 1, open.end());
        }
        open.push_back({t, true});
        open.push_back({t, false});
    }
    return tree;
}

// Which of the indices are fresh, and the others.
struct IndexStream {
    std::vector<bool> fresh;
    std::vector<uint8_t> known;
    uint8_t seen = 0;

    void add(uint8_t vertex) {
        fresh.push_back(vertex == seen);
        if (vertex == seen) {
            ++seen;
        } else {
            known.push_back(vertex);
        }
    }
};

IndexStream indexStream(std::span<const LocalTriangle> triangles, const Tree& tree) {
    IndexStream stream;
    for (size_t t = 0; t < triangles.size(); ++t) {
        const bool isRoot = (tree.root >> t & 1) != 0;
        for (size_t k = isRoot ? 0 : 2; k < 3; ++k) stream.add(triangles[t][k]);
    }
    return stream;
}

ClusterHeader headerOf(const LocalMesh& local, const Tree& tree, uint32_t first) {
    std::array<OffsetRange, 3> ranges = rangesOf(local.points);
    const Tilt tilt = findTilt(local.points, ranges);
    ranges[tilt.axis] = tilt.range;
    ClusterHeader head;
    head.firstTriangle = first;
    for (size_t axis = 0; axis < 3; ++axis) {
        head.origin[axis] = static_cast<uint32_t>(ranges[axis].low) % latticeLimit;
        head.width[axis] = ranges[axis].width();
    }
    head.tilted = tilt.axis;
    head.slope = tilt.slope;
    head.triangles = static_cast<uint32_t>(local.triangles.size());
    head.vertices = static_cast<uint32_t>(local.points.size());
    head.roots = static_cast<uint32_t>(std::popcount(tree.root));
    return head;
}

// What is left of a point's coordinate above the lowest, the tilt taken off.
void appendOffsets(std::span<const LatticePoint> points, const ClusterHeader& head, BitWriter& bits) {
    const auto [a, b] = levelAxes(head.tilted);
    const auto offset = [&](const LatticePoint& p, unsigned axis) {
        return (static_cast<uint32_t>(p[axis]) - head.origin[axis]) % latticeLimit;
    };
    for (unsigned axis = 0; axis < 3; ++axis) {
        for (const LatticePoint& p : points) {
            uint32_t value = offset(p, axis);
            if (axis == head.tilted)
                value -= static_cast<uint32_t>(tiltOf(head.slope, static_cast<int32_t>(offset(p, a)),
                                                      static_cast<int32_t>(offset(p, b))));
            value %= latticeLimit;
            assert(static_cast<unsigned>(std::bit_width(value)) <= head.width[axis]);
            bits.append(value, head.width[axis]);
        }
    }
}

}  // namespace

void appendCluster(const GridMesh& mesh, uint32_t first, uint32_t count, const Lattice& lattice,
                   std::vector<uint8_t>& records) {
    assert(count > 0 && count <= maxClusterTriangles);
    assert(uint64_t{first} + count <= mesh.looseTriangles.size());
    const LocalMesh local = localMesh(mesh, first, count, lattice);
    const Tree tree = treeOf(local.triangles);
    const IndexStream indices = indexStream(local.triangles, tree);
    const ClusterHeader head = headerOf(local, tree, first);
    BitWriter bits;
    bits.append(tree.right, count);
    bits.append(tree.left, count);
    appendOffsets(local.points, head, bits);
    for (const bool fresh : indices.fresh) bits.append(fresh ? 1 : 0, 1);
    for (const uint8_t vertex : indices.known) bits.append(vertex, head.indexWidth());
    const size_t begin = records.size();
    records.resize(begin + clusterBytes(head, static_cast<uint32_t>(indices.known.size())));
    storeClusterHeader(&records[begin], head);
    for (size_t k = 0; 8 * k < bits.size(); ++k)
        records[begin + clusterHeaderBytes + k] = static_cast<uint8_t>(bits.words()[k / 8] >> 8 * (k % 8));
}

}  // namespace filigree::grid
