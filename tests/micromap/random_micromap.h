// Random flat micromaps for tests.
#pragma once

#include "filigree/micromap/state.h"

#include <random>
#include <vector>

namespace filigree::tests {

// A flat 4-state micromap made of nested uniform parts: each node of the quadtree stops with probability
// `stop`.
inline void fillRandomly(std::vector<uint8_t>& flat, uint64_t first, unsigned height, double stop,
                         std::mt19937& random) {
    if (height == 0 || std::uniform_real_distribution<>(0, 1)(random) < stop) {
        const unsigned state = random() % 4;
        const uint64_t count = micromap::microTriangleCount(height);
        for (uint64_t k = first; k < first + count; ++k) {
            flat[k / 4] = static_cast<uint8_t>(flat[k / 4] | (state << (2 * (k % 4))));
        }
        return;
    }
    const uint64_t quarter = micromap::microTriangleCount(height - 1);
    for (unsigned k = 0; k < 4; ++k) fillRandomly(flat, first + k * quarter, height - 1, stop, random);
}

inline std::vector<uint8_t> randomFlat(unsigned level, double stop, std::mt19937& random) {
    std::vector<uint8_t> flat(micromap::flatBytes(level, micromap::Format::fourState), 0);
    fillRandomly(flat, 0, level, stop, random);
    return flat;
}

}  // namespace filigree::tests
