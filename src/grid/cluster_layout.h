// The bytes of clusters: docs/spec/cluster.md.
#pragma once

#include "filigree/core/bytes.h"
#include "filigree/grid/cluster.h"
#include "filigree/grid/encoded_grids.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace filigree::grid {

inline constexpr size_t clusterHeaderBytes = 20;
inline constexpr unsigned widestOffset = 24;  // bits
inline constexpr int leastSlope = -32;        // in 1/32
inline constexpr int mostSlope = 31;

struct ClusterHeader {
    uint32_t firstTriangle = 0;
    std::array<uint32_t, 3> origin{};  // below 2^24
    std::array<unsigned, 3> width{};   // 0..24
    unsigned tilted = 0;               // an axis
    std::array<int, 2> slope{};        // of the other axes, the lower first
    uint32_t triangles = 1;            // 1..64
    uint32_t vertices = 1;             // 1..192
    uint32_t roots = 1;                // 1..64

    [[nodiscard]] unsigned indexWidth() const { return static_cast<unsigned>(std::bit_width(vertices - 1)); }
    [[nodiscard]] uint32_t indices() const { return triangles + 2 * roots; }
};

// The two axes that are not `tilted`, the lower first.
constexpr std::array<unsigned, 2> levelAxes(unsigned tilted) {
    return {tilted == 0 ? 1U : 0U, tilted == 2 ? 1U : 2U};
}

constexpr int32_t tiltOf(const std::array<int, 2>& slope, int32_t a, int32_t b) {
    return (slope[0] * a + slope[1] * b + 16) >> 5;
}

// Where the parts begin, in bits from the record's first. The known indices end the record.
struct ClusterParts {
    uint32_t right = 8 * clusterHeaderBytes;
    uint32_t left = 0;
    std::array<uint32_t, 3> offsets{};
    uint32_t fresh = 0;
    uint32_t known = 0;
};

inline ClusterParts clusterParts(const ClusterHeader& head) {
    ClusterParts parts;
    parts.left = parts.right + head.triangles;
    uint32_t at = parts.left + head.triangles;
    for (size_t axis = 0; axis < 3; ++axis) {
        parts.offsets[axis] = at;
        at += head.vertices * head.width[axis];
    }
    parts.fresh = at;
    parts.known = at + head.indices();
    return parts;
}

// In bytes; `known` indices are not fresh.
inline size_t clusterBytes(const ClusterHeader& head, uint32_t known) {
    constexpr size_t unitBits = 8 * EncodedGrids::recordUnit;
    const size_t bits = clusterParts(head).known + size_t{known} * head.indexWidth();
    return (bits + unitBits - 1) / unitBits * EncodedGrids::recordUnit;
}

// From clusterHeaderBytes bytes; any are a header, though not all a valid one (checkCluster).
inline ClusterHeader loadClusterHeader(const uint8_t* from) {
    const auto word = [&](size_t k) { return loadLe<uint32_t>(from + 4 * k); };
    ClusterHeader head;
    head.firstTriangle = word(0);
    for (size_t axis = 0; axis < 3; ++axis) {
        head.origin[axis] = word(1 + axis) & 0xffffff;
        head.width[axis] = word(1 + axis) >> 24 & 31;
    }
    head.tilted = word(1) >> 29 & 3;
    head.triangles = 1 + (word(4) & 63);
    head.vertices = 1 + (word(4) >> 6 & 255);
    head.roots = 1 + (word(4) >> 14 & 63);
    head.slope[0] = static_cast<int32_t>(word(4) << 6) >> 26;
    head.slope[1] = static_cast<int32_t>(word(4)) >> 26;
    return head;
}

inline void storeClusterHeader(uint8_t* to, const ClusterHeader& head) {
    storeLe(to, head.firstTriangle);
    for (size_t axis = 0; axis < 3; ++axis) {
        const uint32_t tilted = axis == 0 ? head.tilted << 29 : 0;
        storeLe(to + 4 + 4 * axis, head.origin[axis] | head.width[axis] << 24 | tilted);
    }
    const auto slope = [&](size_t k) { return static_cast<uint32_t>(head.slope[k]) & 63; };
    storeLe(to + 16, (head.triangles - 1) | (head.vertices - 1) << 6 | (head.roots - 1) << 14 |
                         slope(0) << 20 | slope(1) << 26);
}

// `count` bits from bit `at` on, at most 57; may read 8 bytes from the first of them.
inline uint64_t clusterBits(const uint8_t* record, uint32_t at, unsigned count) {
    return loadLe<uint64_t>(record + at / 8) >> at % 8 & ((uint64_t{1} << count) - 1);
}

}  // namespace filigree::grid
