// A ray against the triangles of a cluster: included once for each SIMD target.
#if defined(FILIGREE_GRID_TRIANGLE_TEST_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FILIGREE_GRID_TRIANGLE_TEST_INL_H_
#undef FILIGREE_GRID_TRIANGLE_TEST_INL_H_
#else
#define FILIGREE_GRID_TRIANGLE_TEST_INL_H_
#endif

#include "filigree/grid/cluster.h"

#include "grid/block_test-inl.h"

HWY_BEFORE_NAMESPACE();
namespace filigree::grid::HWY_NAMESPACE {

// Where a cluster's coordinate lies on an axis of the records, as Lattice::positionOf has it.
struct PlaceOnLattice {
    double origin = 0;
    double step = 1;
    [[nodiscard]] float at(int32_t coordinate) const {
        return static_cast<float>(origin + step * coordinate);
    }
};

class TriangleTest {
  public:
    TriangleTest(const ClusterTriangles& cluster, const std::array<PlaceOnLattice, 3>& axes, TracedRay& ray)
        : cluster_(cluster), ray_(ray) {
        for (size_t k = 0; k < 3; ++k)
            for (size_t vertex = 0; vertex < cluster.vertexCount; ++vertex)
                points_[k][vertex] = axes[k].at(cluster.vertices[k][vertex]);
    }

    // Whether something nearer was hit.
    bool run(bool any) {
        bool isHit = false;
        for (uint32_t first = 0; first < cluster_.triangleCount && !(any && isHit); first += 16) {
            isHit |= testSixteen(first);
        }
        return isHit;
    }

  private:
    HWY_INLINE SeenCorners corner(const RayLanes& lanes, size_t which, uint32_t first) const {
        alignas(64) std::array<std::array<float, 16>, 3> at;
        for (size_t k = 0; k < 16; ++k) {
            // Behind the last triangle the last again.
            const size_t triangle = std::min<size_t>(first + k, cluster_.triangleCount - 1);
            const uint8_t vertex = cluster_.corners[which][triangle];
            for (size_t axis = 0; axis < 3; ++axis) at[axis][k] = points_[ray_.axes[axis]][vertex];
        }
        return lanes.see(load(at[0].data()), load(at[1].data()), load(at[2].data()));
    }

    bool testSixteen(uint32_t first) {
        const RayLanes lanes(ray_);
        const SeenCorners p = corner(lanes, 0, first), q = corner(lanes, 1, first),
                          r = corner(lanes, 2, first);
        const F16 pq = edgeOf(p, q), qr = edgeOf(q, r), rp = edgeOf(r, p);
        const uint32_t there =
            cluster_.triangleCount - first >= 16 ? 0xffff : (1U << (cluster_.triangleCount - first)) - 1;
        uint32_t left = enclosing(pq, qr, rp) & there;
        if (left == 0) return false;
        CornerLanes keptP, keptQ, keptR;
        keptP.keep(p);
        keptQ.keep(q);
        keptR.keep(r);
        alignas(64) std::array<std::array<float, 16>, 3> e;
        store(qr, e[0].data());
        store(rp, e[1].data());
        store(pq, e[2].data());
        bool isHit = false;
        for (; left != 0; left &= left - 1) {
            const auto k = static_cast<unsigned>(std::countr_zero(left));
            const LaneTriangle triangle{
                keptP.lane(k), keptQ.lane(k), keptR.lane(k), {e[0][k], e[1][k], e[2][k]}};
            if (!hitTriangle(triangle, ray_)) continue;
            isHit = true;
            note(first + k);
        }
        return isHit;
    }

    void note(uint32_t triangle) {
        // Later triangles at the same distance must not count as first hits.
        ray_.hit.leaf = 0;
        ray_.hit.quad = static_cast<uint8_t>(triangle);
        ray_.hit.half = 0;
        for (size_t c = 0; c < 3; ++c) {
            const uint8_t vertex = cluster_.corners[c][triangle];
            ray_.hit.corners[c] = {points_[0][vertex], points_[1][vertex], points_[2][vertex]};
        }
    }

    const ClusterTriangles& cluster_;
    TracedRay& ray_;
    std::array<std::array<float, maxClusterVertices>, 3> points_;
};

}  // namespace filigree::grid::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
