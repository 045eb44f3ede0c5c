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

// The offsets of one axis, one a lane. They come out of one vector of bytes, as 4 lanes and more of 24 bits
// and 7 in front fit into their own size; gathers are slow where processors had to be mended.
class OffsetLanes {
  public:
    OffsetLanes(const uint8_t* record, uint32_t begin, unsigned width)
        : record_(record), begin_(begin), width_(width) {}

    // From vertex `first` on.
    [[nodiscard]] ClusterVector from(uint32_t first) const {
        const uint32_t at = begin_ + first * width_;
        if constexpr (HWY_TARGET == HWY_SCALAR) {
            return hn::Set(d_, static_cast<int32_t>(clusterBits(record_, at, width_)));
        } else {
            const hn::RebindToUnsigned<ClusterLanes> du;
            const auto words = hn::LoadU(du, reinterpret_cast<const uint32_t*>(record_ + at / 8));
            const auto bit = hn::Add(hn::Mul(hn::Iota(d_, 0), hn::Set(d_, static_cast<int32_t>(width_))),
                                     hn::Set(d_, static_cast<int32_t>(at % 8)));
            const auto word = hn::ShiftRight<5>(bit);
            const auto last = hn::Set(d_, static_cast<int32_t>(hn::Lanes(d_)) - 1);
            const auto next = hn::Min(hn::Add(word, hn::Set(d_, 1)), last);
            const auto low = hn::TableLookupLanes(words, hn::IndicesFromVec(du, word));
            const auto high = hn::TableLookupLanes(words, hn::IndicesFromVec(du, next));
            const auto shift = hn::BitCast(du, hn::And(bit, hn::Set(d_, 31)));
            const auto above = hn::Shl(hn::ShiftLeft<1>(high), hn::Sub(hn::Set(du, 31), shift));
            const auto mask = hn::Set(du, (1U << width_) - 1);
            return hn::BitCast(d_, hn::And(hn::Or(hn::Shr(low, shift), above), mask));
        }
    }

  private:
    static constexpr ClusterLanes d_{};
    const uint8_t* record_;
    uint32_t begin_;
    unsigned width_;
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
        const auto oa = first.from(v);
        const auto ob = second.from(v);
        const auto slopes =
            hn::Add(hn::Mul(oa, hn::Set(d, head.slope[0])), hn::Mul(ob, hn::Set(d, head.slope[1])));
        const auto tilt = hn::ShiftRight<5>(hn::Add(slopes, hn::Set(d, 16)));
        put(a, v, oa);
        put(b, v, ob);
        put(head.tilted, v, hn::Add(tilted.from(v), tilt));
    }
}

}  // namespace filigree::grid::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace filigree::grid {
namespace {

HWY_EXPORT(decodeClusterVertices);

// `a` where `bit` is 1, `b` where it is 0: without a branch, as none could be foretold.
constexpr uint32_t chosen(uint32_t bit, uint32_t a, uint32_t b) {
    return b ^ ((a ^ b) & (0 - bit));
}

// All indices, one after another.
void expandIndices(const uint8_t* record, const ClusterHeader& head, const ClusterParts& parts,
                   uint8_t* indices) {
    const unsigned width = head.indexWidth();
    const uint32_t mask = (1U << width) - 1;
    uint32_t known = parts.known;
    uint32_t fresh = 0;
    for (uint32_t i = 0; i < head.indices(); ++i) {
        const uint32_t flag = parts.fresh + i;
        const uint32_t isFresh = record[flag / 8] >> flag % 8 & 1;
        const uint32_t index = loadLe<uint16_t>(record + known / 8) >> known % 8 & mask;
        indices[i] = static_cast<uint8_t>(chosen(isFresh, fresh, index));
        fresh += isFresh;
        known += width & (isFresh - 1);
    }
}

// Edges in one number, from + to * 256. The edge that comes next is kept out of the stack.
void placeTriangles(uint64_t right, uint64_t left, const uint8_t* indices, ClusterTriangles& out) {
    std::array<uint32_t, maxClusterTriangles + 2> stack;  // the lowest stays unused
    stack[0] = 0;
    uint32_t stacked = 0;
    uint32_t next = 0;
    bool isRoot = true;
    for (uint32_t t = 0; t < out.triangleCount; ++t, right >>= 1, left >>= 1) {
        if (isRoot) {
            next = indices[0] | uint32_t{indices[1]} << 8;
            indices += 2;
        }
        const uint32_t c2 = *indices++;
        out.corners[0][t] = static_cast<uint8_t>(next);
        out.corners[1][t] = static_cast<uint8_t>(next >> 8);
        out.corners[2][t] = static_cast<uint8_t>(c2);
        const auto goesRight = static_cast<uint32_t>(right & 1);
        const auto goesLeft = static_cast<uint32_t>(left & 1);
        const uint32_t leftEdge = (next & 0xff) | c2 << 8;
        const uint32_t rightEdge = c2 | (next & 0xff00);
        const uint32_t popped = stack[stacked];
        stack[stacked + 1] = leftEdge;
        next = chosen(goesRight, rightEdge, chosen(goesLeft, leftEdge, popped));
        isRoot = (goesRight | goesLeft | stacked) == 0;
        stacked = stacked + goesRight + goesLeft - (isRoot ? 0 : 1);
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
