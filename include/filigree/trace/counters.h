// What rays cost.
#pragma once

#include "filigree/core/api.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace filigree::trace {

// What rays are for.
enum class RayKind : uint8_t { primary, shadow, ao, bounce };
inline constexpr size_t rayKindCount = 4;
// For reports.
FILIGREE_API std::string_view nameOf(RayKind kind);

// Counts of one kind of rays.
struct RayCounts {
    uint64_t rays = 0;
    uint64_t candidateHits = 0;   // with surfaces that have an alpha test
    uint64_t lookups = 0;         // of states; special indices need none
    uint64_t unknown = 0;         // candidates that no state decided
    uint64_t textureFetches = 0;  // any-hit calls: texture coordinates interpolated, alpha filtered
    uint64_t bitsRead = 0;        // by lookups, where they are counted; docs/spec/bits-read.md

    void add(const RayCounts& other) {
        rays += other.rays;
        candidateHits += other.candidateHits;
        lookups += other.lookups;
        unknown += other.unknown;
        textureFetches += other.textureFetches;
        bitsRead += other.bitsRead;
    }
};

// Counts by kind of ray.
struct Counters {
    std::array<RayCounts, rayKindCount> of{};

    RayCounts& operator[](RayKind kind) { return of[static_cast<size_t>(kind)]; }
    const RayCounts& operator[](RayKind kind) const { return of[static_cast<size_t>(kind)]; }
    [[nodiscard]] RayCounts total() const {
        RayCounts sum;
        for (const RayCounts& counts : of) sum.add(counts);
        return sum;
    }
    void add(const Counters& other) {
        for (size_t k = 0; k < rayKindCount; ++k) of[k].add(other.of[k]);
    }
};

}  // namespace filigree::trace
