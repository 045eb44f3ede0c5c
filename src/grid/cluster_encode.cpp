#include "filigree/core/bits.h"

#include "grid/cluster_layout.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>

namespace filigree::grid {
namespace {

using LocalTriangle = std::array<uint8_t, 3>;

// The record's triangles over its own vertices, those numbered as they come up.
struct LocalMesh {
    std::vector<LatticePoint> points;
    std::vector<LocalTriangle> triangles;
};

uint8_t localVertex(const LatticePoint& point, std::vector<LatticePoint>& points) {
    const auto found = std::ranges::find(points, point);
    const auto index = static_cast<uint8_t>(found - points.begin());
    if (found == points.end()) points.push_back(point);
    return index;
}

LocalMesh localMesh(const GridMesh& mesh, uint32_t first, uint32_t count, const Lattice& lattice) {
    LocalMesh local;
    for (uint32_t t = first; t < first + count; ++t) {
        LocalTriangle triangle{};
        for (size_t k = 0; k < 3; ++k) {
            const Vec3& position = mesh.looseVertices[mesh.looseTriangles[t][k]];
            triangle[k] = localVertex(lattice.pointAt(position), local.points);
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

// The lowest value and the width of what lies above it.
struct OffsetRange {
    int32_t low = 0;
    unsigned width = 0;
};

template <class ValueOf>
OffsetRange rangeOf(std::span<const LatticePoint> points, const ValueOf& valueOf) {
    int32_t low = std::numeric_limits<int32_t>::max();
    int32_t high = std::numeric_limits<int32_t>::min();
    for (const LatticePoint& p : points) {
        const int32_t value = valueOf(p);
        low = std::min(low, value);
        high = std::max(high, value);
    }
    return {low, static_cast<unsigned>(std::bit_width(static_cast<uint32_t>(high - low)))};
}

struct Tilt {
    unsigned axis = 0;
    std::array<int, 2> slope{};
    OffsetRange range;
};

// Looks for the slopes that leave the least of one axis: from those of the plane through the points on,
// stepwise.
class TiltSearch {
  public:
    TiltSearch(std::span<const LatticePoint> points, const std::array<OffsetRange, 3>& ranges)
        : points_(points), ranges_(ranges) {}

    Tilt find() {
        Tilt best = along(0, {0, 0});
        for (unsigned axis = 0; axis < 3; ++axis) {
            const Tilt level = along(axis, {0, 0});
            const Tilt tilt = improved(along(axis, planeSlopes(axis)));
            const auto gain = [](const Tilt& from, const Tilt& to) {
                return static_cast<int>(from.range.width) - static_cast<int>(to.range.width);
            };
            if (tilt.range.width <= widestOffset && gain(level, tilt) > bestGain_) {
                bestGain_ = gain(level, tilt);
                best = tilt;
            }
        }
        return best;
    }

  private:
    [[nodiscard]] Tilt along(unsigned axis, const std::array<int, 2>& slope) const {
        const auto [a, b] = levelAxes(axis);
        return {axis, slope, rangeOf(points_, [&, a = a, b = b](const LatticePoint& p) {
                    return p[axis] - tiltOf(slope, p[a] - ranges_[a].low, p[b] - ranges_[b].low);
                })};
    }

    // The least squares' plane through the points, in 1/32.
    [[nodiscard]] std::array<int, 2> planeSlopes(unsigned axis) const {
        const auto [a, b] = levelAxes(axis);
        std::array<double, 3> mean{};
        for (const LatticePoint& p : points_) {
            for (size_t k = 0; k < 3; ++k) mean[k] += p[k] / static_cast<double>(points_.size());
        }
        double aa = 0, ab = 0, bb = 0, ah = 0, bh = 0;
        for (const LatticePoint& p : points_) {
            const double x = p[a] - mean[a];
            const double y = p[b] - mean[b];
            const double h = p[axis] - mean[axis];
            aa += x * x;
            ab += x * y;
            bb += y * y;
            ah += x * h;
            bh += y * h;
        }
        const double determinant = aa * bb - ab * ab;
        if (!(determinant > 1e-9 * aa * bb)) return {slopeOf(ah, aa), 0};
        return {slopeOf(ah * bb - bh * ab, determinant), slopeOf(bh * aa - ah * ab, determinant)};
    }

    static int slopeOf(double above, double below) {
        if (!(below > 0)) return 0;
        return static_cast<int>(
            std::clamp(std::round(32 * above / below), double{leastSlope}, double{mostSlope}));
    }

    // The spread of what is left, finer than its width.
    [[nodiscard]] int32_t spread(const Tilt& tilt) const {
        const auto [a, b] = levelAxes(tilt.axis);
        int32_t high = std::numeric_limits<int32_t>::min();
        for (const LatticePoint& p : points_) {
            high = std::max(high,
                            p[tilt.axis] - tiltOf(tilt.slope, p[a] - ranges_[a].low, p[b] - ranges_[b].low));
        }
        return high - tilt.range.low;
    }

    [[nodiscard]] Tilt improved(Tilt tilt) const {
        int32_t least = spread(tilt);
        for (bool better = true; better;) {
            better = false;
            for (size_t k = 0; k < 2; ++k) {
                for (const int step : {-1, 1}) {
                    std::array<int, 2> slope = tilt.slope;
                    slope[k] = std::clamp(slope[k] + step, leastSlope, mostSlope);
                    const Tilt next = along(tilt.axis, slope);
                    if (spread(next) >= least) continue;
                    least = spread(next);
                    tilt = next;
                    better = true;
                }
            }
        }
        return tilt;
    }

    std::span<const LatticePoint> points_;
    const std::array<OffsetRange, 3>& ranges_;
    int bestGain_ = 0;
};

ClusterHeader headerOf(const LocalMesh& local, const Tree& tree, uint32_t first) {
    std::array<OffsetRange, 3> ranges{};
    for (unsigned axis = 0; axis < 3; ++axis)
        ranges[axis] = rangeOf(local.points, [&](const LatticePoint& p) { return p[axis]; });
    const Tilt tilt = TiltSearch(local.points, ranges).find();
    ranges[tilt.axis] = tilt.range;
    ClusterHeader head;
    head.firstTriangle = first;
    for (size_t axis = 0; axis < 3; ++axis) {
        head.origin[axis] = static_cast<uint32_t>(ranges[axis].low) % latticeLimit;
        head.width[axis] = ranges[axis].width;
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
            assert(std::bit_width(value) <= head.width[axis]);
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
