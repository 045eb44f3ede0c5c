// What a scene's micromaps may lose when they are encoded, and what they lost.
#pragma once

#include "filigree/report/table.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace filigree::jobs {

// At most one of them.
struct LossOptions {
    // Payload and descriptors take at most so many bytes, at about the least loss (docs/spec/lossy.md).
    std::optional<uint64_t> maxBytes;
    // 4-state: about the fewest bytes with at most so many per cent more expected any-hit calls, of those
    // that the lossless maps expect (of all hits where they expect none).
    std::optional<double> maxExtraAnyhit;
    // 2-state: likewise with so many per cent of the area on another side.
    std::optional<double> maxChangedArea;
    // One bit a micro-triangle with an unknown state (docs/spec/one-bit.md), from 4-state maps.
    bool oneBit = false;

    [[nodiscard]] bool isLossy() const { return maxBytes || maxExtraAnyhit || maxChangedArea; }
};

// One point of a rate curve.
struct RatePoint {
    uint64_t bytes = 0;  // payload and descriptors
    // 4-state: more expected any-hit calls, as a share of those of the lossless maps (of all hits where they
    // expect none). 2-state: share of the area on another side.
    double loss = 0;
    double knownShare = 1;  // of the area
};

struct LossySummary {
    unsigned states = 4;     // how `loss` is to be read
    double anyhitShare = 0;  // of hits, uniform by area: what the lossless maps expect
    RatePoint chosen;
    std::vector<RatePoint> curve;  // by falling bytes; the first is lossless
};

struct OneBitSummary {
    uint64_t pairBytes = 0;
    std::array<uint64_t, 3> maps{};  // by encoding::StatePair
    uint64_t bytes = 0;              // payload, descriptors and pairs
    double knownShare = 0;           // of the area
    // The same maps, equal ones once, in the same encoding.
    uint64_t twoStateBytes = 0;
    uint64_t fourStateBytes = 0;
    double fourStateKnownShare = 0;
};

// The rate curve, one row a point.
report::Table rateTable(const LossySummary& summary);

}  // namespace filigree::jobs
