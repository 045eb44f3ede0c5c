// The directory of indexed trees: docs/spec/indexed-tree.md.
#pragma once

#include "filigree/core/bytes.h"

#include <cstdint>

namespace filigree::encoding {

// Every `sampleStep`-th leaf but the first stands in the directory.
inline constexpr uint64_t sampleStep = 64;

// Zero bytes at the end of the payload, so that 8 bytes can be loaded anywhere before.
inline constexpr uint64_t indexedTreeTailBytes = 8;

// Of a tree of `inner` inner nodes, which has 3 * inner + 1 leaves.
constexpr uint64_t sampleCount(uint64_t inner) {
    return 3 * inner / sampleStep;
}

// A sample is the curve index that a leaf begins at.
constexpr unsigned sampleBytes(unsigned level) {
    return (2 * level + 7) / 8;
}
constexpr uint64_t directoryBytes(uint64_t inner, unsigned level) {
    return sampleCount(inner) * sampleBytes(level);
}

// Sample 1..sampleCount; loads 4 bytes.
inline uint32_t loadSample(const uint8_t* directory, uint64_t sample, unsigned level) {
    const unsigned bytes = sampleBytes(level);
    return loadLe<uint32_t>(directory + (sample - 1) * bytes) & ((1u << (8 * bytes)) - 1);
}

}  // namespace filigree::encoding
