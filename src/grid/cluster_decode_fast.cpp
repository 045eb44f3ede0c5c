// The fast decoder of clusters: offsets a vector at a time, indices through one 64-bit load each.
#include "grid/cluster_layout.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "grid/cluster_decode_fast.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace filigree::grid::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using ClusterLanes = hn::CappedTag<int32_t, 16>;
using ClusterVector = hn::VFromD<ClusterLanes>;

// The offsets of one axis, one a lane.
class OffsetLanes {
  public:
    OffsetLanes(const uint8_t* record, uint32_t begin, unsigned width)
        : record_(record),
          begin_(hn::Set(d_, static_cast<int32_t>(begin))),
          width_(hn::Set(d_, static_cast<int32_t>(width))),
          mask_(hn::Set(d_, static_cast<int32_t>((1U << width) - 1))) {}

    [[nodiscard]] ClusterVector of(ClusterVector vertex) const {
        const hn::RebindToUnsigned<ClusterLanes> du;
        const auto bit = hn::Add(begin_, hn::Mul(vertex, width_));
        const auto words =
            hn::GatherOffset(d_, reinterpret_cast<const int32_t*>(record_), hn::ShiftRight<3>(bit));
        const auto shift = hn::BitCast(du, hn::And(bit, hn::Set(d_, 7)));
        return hn::And(hn::BitCast(d_, hn::Shr(hn::BitCast(du, words), shift)), mask_);
    }

  private:
    static constexpr ClusterLanes d_{};
    const uint8_t* record_;
    ClusterVector begin_;
    ClusterVector width_;
    ClusterVector mask_;
};

void decodeClusterVertices(const uint8_t* record, const ClusterHeader& head, const ClusterParts& parts,
                           ClusterTriangles& out) {
    const ClusterLanes d;
    const auto lanes = static_cast<uint32_t>(hn::Lanes(d));
    const auto [a, b] = levelAxes(head.tilted);
    const auto axis = [&](unsigned k) { return OffsetLanes(record, parts.offsets[k], head.width[k]); };
    const OffsetLanes first = axis(a);
    const OffsetLanes second = axis(b);
    const OffsetLanes tilted = axis(head.tilted);
    const auto put = [&](unsigned k, uint32_t v, ClusterVector offset) {
        const auto sum = hn::Add(offset, hn::Set(d, static_cast<int32_t>(head.origin[k])));
        hn::Store(hn::And(sum, hn::Set(d, latticeLimit - 1)), d, &out.vertices[k][v]);
    };
    for (uint32_t v = 0; v < head.vertices; v += lanes) {
        const auto vertex = hn::Iota(d, static_cast<int32_t>(v));
        const auto oa = first.of(vertex);
        const auto ob = second.of(vertex);
        const auto slopes =
            hn::Add(hn::Mul(oa, hn::Set(d, head.slope[0])), hn::Mul(ob, hn::Set(d, head.slope[1])));
        const auto tilt = hn::ShiftRight<5>(hn::Add(slopes, hn::Set(d, 16)));
        put(a, v, oa);
        put(b, v, ob);
        put(head.tilted, v, hn::Add(tilted.of(vertex), tilt));
    }
}

}  // namespace filigree::grid::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace filigree::grid {
namespace {

HWY_EXPORT(decodeClusterVertices);

// All indices, one after another.
void expandIndices(const uint8_t* record, const ClusterHeader& head, const ClusterParts& parts,
                   uint8_t* indices) {
    const unsigned width = head.indexWidth();
    const uint64_t mask = (uint64_t{1} << width) - 1;
    uint32_t known = parts.known;
    uint32_t fresh = 0;
    for (uint32_t i = 0; i < head.indices(); ++i) {
        const auto isFresh =
            static_cast<uint32_t>(record[(parts.fresh + i) / 8] >> (parts.fresh + i) % 8 & 1);
        const auto index = static_cast<uint32_t>(loadLe<uint64_t>(record + known / 8) >> known % 8 & mask);
        indices[i] = static_cast<uint8_t>(isFresh != 0 ? fresh : index);
        fresh += isFresh;
        known += isFresh != 0 ? 0 : width;
    }
}

// Keeps the top of the stack in two variables' place: both edges are written, the stack moves by the bits.
void placeTriangles(uint64_t right, uint64_t left, const uint8_t* indices, ClusterTriangles& out) {
    std::array<std::array<uint8_t, 2>, maxClusterTriangles + 3> stack;
    size_t stacked = 0;
    for (uint32_t t = 0; t < out.triangleCount; ++t) {
        if (stacked == 0) {
            stack[stacked++] = {indices[0], indices[1]};
            indices += 2;
        }
        const auto [c0, c1] = stack[--stacked];
        const uint8_t c2 = *indices++;
        out.corners[0][t] = c0;
        out.corners[1][t] = c1;
        out.corners[2][t] = c2;
        stack[stacked] = {c0, c2};
        stacked += left >> t & 1;
        stack[stacked] = {c2, c1};
        stacked += right >> t & 1;
    }
}

uint64_t flagsOf(const uint8_t* record, uint32_t at, uint32_t count) {
    const uint64_t low = loadLe<uint64_t>(record + at / 8) >> at % 8;
    const uint64_t high = at % 8 == 0 ? 0 : uint64_t{record[at / 8 + 8]} << (64 - at % 8);
    return (low | high) & (~uint64_t{0} >> (64 - count));
}

}  // namespace

void decodeCluster(const uint8_t* record, ClusterTriangles& out) {
    const ClusterHeader head = loadClusterHeader(record);
    const ClusterParts parts = clusterParts(head);
    out.firstTriangle = head.firstTriangle;
    out.triangleCount = head.triangles;
    out.vertexCount = head.vertices;
    HWY_DYNAMIC_DISPATCH(decodeClusterVertices)(record, head, parts, out);
    std::array<uint8_t, maxClusterVertices> indices;
    expandIndices(record, head, parts, indices.data());
    placeTriangles(flagsOf(record, parts.right, head.triangles), flagsOf(record, parts.left, head.triangles),
                   indices.data(), out);
}

}  // namespace filigree::grid
#endif
