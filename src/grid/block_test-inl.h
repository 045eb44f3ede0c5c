// A ray against all triangles of a block at once: included once for each SIMD target.
#if defined(FILIGREE_GRID_BLOCK_TEST_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FILIGREE_GRID_BLOCK_TEST_INL_H_
#undef FILIGREE_GRID_BLOCK_TEST_INL_H_
#else
#define FILIGREE_GRID_BLOCK_TEST_INL_H_
#endif

#include "grid/block.h"
#include "grid/lanes-inl.h"
#include "grid/traced_ray.h"

#include <bit>

HWY_BEFORE_NAMESPACE();
namespace filigree::grid::HWY_NAMESPACE {

// Corners seen along the ray: x and y across it, z before it is scaled to t.
struct SeenCorners {
    F16 x, y, z;
};

struct RayLanes {
    explicit HWY_INLINE RayLanes(const TracedRay& ray)
        : origin{all(ray.origin[ray.axes[0]]), all(ray.origin[ray.axes[1]]), all(ray.origin[ray.axes[2]])},
          shearX(all(ray.shearX)),
          shearY(all(ray.shearY)) {}

    [[nodiscard]] HWY_INLINE SeenCorners see(const F16& x, const F16& y, const F16& z) const {
        const F16 far = z - origin[2];
        return {x - origin[0] - shearX * far, y - origin[1] - shearY * far, far};
    }

    F16 origin[3];
    F16 shearX, shearY;
};

// Twice the area of the triangle that the ray makes with p and q; of (q, p) exactly the negative, so that of
// two triangles at an edge at least one takes the ray.
HWY_INLINE F16 edgeOf(const SeenCorners& p, const SeenCorners& q) {
    return q.x * p.y - q.y * p.x;
}

// Lanes where no edge is passed on another side than the others. Where all three are zero a triangle has no
// area to hit, or too little for floats to tell: hitTriangle finds out.
HWY_INLINE uint32_t enclosing(const F16& a, const F16& b, const F16& c) {
    const F16 zero = all(0.0F);
    return bitsNotAbove(zero, least(least(a, b), c)) | bitsNotAbove(greatest(greatest(a, b), c), zero);
}

// The triangle p q r of one lane, whose edges' values are opposite them.
struct LaneTriangle {
    Vec3 p, q, r;
    std::array<float, 3> edges;
};

// Shortens the ray where it hits, edges exact where floats could not tell their sign.
inline bool hitTriangle(const LaneTriangle& triangle, TracedRay& ray) {
    std::array<double, 3> weight{triangle.edges[0], triangle.edges[1], triangle.edges[2]};
    const auto edge = [](const Vec3& a, const Vec3& b) { return double{b[0]} * a[1] - double{b[1]} * a[0]; };
    if (weight[0] == 0 || weight[1] == 0 || weight[2] == 0) {
        weight = {edge(triangle.q, triangle.r), edge(triangle.r, triangle.p), edge(triangle.p, triangle.q)};
        const bool isAbove = weight[0] >= 0 && weight[1] >= 0 && weight[2] >= 0;
        const bool isBelow = weight[0] <= 0 && weight[1] <= 0 && weight[2] <= 0;
        if (isAbove == isBelow) return false;
    }
    const double sum = weight[0] + weight[1] + weight[2];
    const double far = weight[0] * triangle.p[2] + weight[1] * triangle.q[2] + weight[2] * triangle.r[2];
    const auto t = static_cast<float>(far / sum * ray.scaleZ);
    if (!(t >= ray.tMin) || !(t < ray.tMax || (t == ray.tMax && ray.hit.leaf == bvh::noLeaf))) return false;
    ray.tMax = t;
    ray.hit.u = static_cast<float>(weight[1] / sum);
    ray.hit.v = static_cast<float>(weight[2] / sum);
    return true;
}

// Corners of quads, [axis][lane], to read single lanes from.
struct CornerLanes {
    alignas(64) std::array<std::array<float, 16>, 3> at;
    HWY_INLINE void keep(const SeenCorners& corners) {
        store(corners.x, at[0].data());
        store(corners.y, at[1].data());
        store(corners.z, at[2].data());
    }
    [[nodiscard]] Vec3 lane(unsigned k) const { return {at[0][k], at[1][k], at[2][k]}; }
};

// Where in a block the corners of its 16 quads are.
struct QuadCorners {
    alignas(64) std::array<int32_t, 16> a, b, c, d;
};
constexpr QuadCorners quadCornersOfPatch() {
    QuadCorners corners{};
    for (int32_t k = 0; k < 16; ++k) {
        const auto at = static_cast<size_t>(k);
        corners.a[at] = k / 4 * 5 + k % 4;
        corners.b[at] = corners.a[at] + 1;
        corners.c[at] = corners.a[at] + 6;
        corners.d[at] = corners.a[at] + 5;
    }
    return corners;
}
inline constexpr QuadCorners quadCorners = quadCornersOfPatch();

// Both triangles of all quads p q r s whose diagonal is p r. Calls found(lane, half, weights...) for the
// nearest only once it is known.
class BlockTest {
  public:
    HWY_INLINE BlockTest(const Block& block, TracedRay& ray) : block_(block), ray_(ray) {
        const RayLanes lanes(ray);
        const auto seen = [&](size_t half) {
            const auto axis = [&](unsigned k) { return load(block.points[ray.axes[k]].data() + 16 * half); };
            return lanes.see(axis(0), axis(1), axis(2));
        };
        const SeenCorners low = seen(0);
        const SeenCorners high = seen(1);
        const auto corner = [&](const std::array<int32_t, 16>& places) {
            return SeenCorners{pick(low.x, high.x, places.data()), pick(low.y, high.y, places.data()),
                               pick(low.z, high.z, places.data())};
        };
        a_ = corner(quadCorners.a);
        b_ = corner(quadCorners.b);
        c_ = corner(quadCorners.c);
        d_ = corner(quadCorners.d);
    }

    // Whether something nearer was hit.
    bool run() {
        bool isHit = false;
        if (const uint32_t ac = block_.quads & ~block_.bd; ac != 0)
            isHit = testQuads(ac, a_, b_, c_, d_, false);
        if (const uint32_t bd = block_.quads & block_.bd; bd != 0)
            isHit |= testQuads(bd, b_, c_, d_, a_, true);
        return isHit;
    }

  private:
    // Triangles p q r and p r s.
    HWY_INLINE bool testQuads(uint32_t quads, const SeenCorners& p, const SeenCorners& q,
                              const SeenCorners& r, const SeenCorners& s, bool isBd) {
        const F16 pq = edgeOf(p, q), qr = edgeOf(q, r), rs = edgeOf(r, s), sp = edgeOf(s, p);
        const F16 pr = edgeOf(p, r);
        const F16 rp = all(0.0F) - pr;
        const uint32_t first = enclosing(pq, qr, rp) & quads;
        const uint32_t second = enclosing(rs, sp, pr) & quads;
        if ((first | second) == 0) return false;
        return finish(first, second, {p, q, r, s}, {pq, qr, rs, sp, pr}, isBd);
    }

    struct Edges {
        F16 pq, qr, rs, sp, pr;
    };
    struct Corners {
        SeenCorners p, q, r, s;
    };

    HWY_NOINLINE bool finish(uint32_t first, uint32_t second, const Corners& corners, const Edges& edges,
                             bool isBd) {
        CornerLanes p, q, r, s;
        p.keep(corners.p);
        q.keep(corners.q);
        r.keep(corners.r);
        s.keep(corners.s);
        alignas(64) std::array<std::array<float, 16>, 5> e;
        store(edges.pq, e[0].data());
        store(edges.qr, e[1].data());
        store(edges.rs, e[2].data());
        store(edges.sp, e[3].data());
        store(edges.pr, e[4].data());
        bool isHit = false;
        for (uint32_t left = first | second; left != 0; left &= left - 1) {
            const auto k = static_cast<unsigned>(std::countr_zero(left));
            const uint32_t bit = left & (~left + 1);
            // Triangles in the order of grid/vertex_grid.h, from its vertices on: of a quad a b c d with the
            // diagonal b d, p is b, and the first half a b d is s p r.
            if ((first & bit) != 0) {
                const LaneTriangle triangle{p.lane(k), q.lane(k), r.lane(k), {e[1][k], -e[4][k], e[0][k]}};
                if (hitTriangle(triangle, ray_)) {
                    isHit = true;
                    note(k, isBd ? 1 : 0);
                }
            }
            if ((second & bit) != 0) {
                if (isBd) {
                    const LaneTriangle triangle{s.lane(k), p.lane(k), r.lane(k), {e[4][k], e[2][k], e[3][k]}};
                    if (hitTriangle(triangle, ray_)) {
                        isHit = true;
                        note(k, 0);
                    }
                } else {
                    const LaneTriangle triangle{p.lane(k), r.lane(k), s.lane(k), {e[2][k], e[3][k], e[4][k]}};
                    if (hitTriangle(triangle, ray_)) {
                        isHit = true;
                        note(k, 1);
                    }
                }
            }
        }
        return isHit;
    }

    void note(unsigned quad, unsigned half) {
        ray_.hit.quad = static_cast<uint8_t>(quad);
        ray_.hit.half = static_cast<uint8_t>(half);
    }

    const Block& block_;
    TracedRay& ray_;
    SeenCorners a_, b_, c_, d_;
};

}  // namespace filigree::grid::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
