// What a leaf of the sdag stands for, before it has bytes.
#pragma once

#include "encoding/sdag_layout.h"

#include <array>
#include <cstdint>

namespace filigree::encoding::sdag {

// 16 states of two bits, state k at bits 2k, by grandchild.
using Pattern = uint32_t;

constexpr Pattern uniformPattern(unsigned state) {
    return 0x55555555u * state;
}
// True for all transparent or all opaque: such a part needs no pattern.
constexpr bool isKnownUniform(Pattern pattern) {
    return pattern == uniformPattern(0) || pattern == uniformPattern(1);
}

// Four levels: 16 patterns by grandchild.
struct Leaf {
    std::array<Pattern, 16> patterns{};
    bool operator==(const Leaf&) const = default;

    // Bit k: pattern k is not known uniform; bit k: it is opaque throughout.
    [[nodiscard]] uint16_t mixed() const {
        unsigned bits = 0;
        for (unsigned k = 0; k < 16; ++k) bits |= (isKnownUniform(patterns[k]) ? 0u : 1u) << k;
        return static_cast<uint16_t>(bits);
    }
    [[nodiscard]] uint16_t opaque() const {
        unsigned bits = 0;
        for (unsigned k = 0; k < 16; ++k) bits |= (patterns[k] == uniformPattern(1) ? 1u : 0u) << k;
        return static_cast<uint16_t>(bits);
    }
};

// Where grandchild k goes under a symmetry.
unsigned turnedGrandchild(unsigned k, unsigned symmetry);

Pattern turned(Pattern pattern, unsigned symmetry);
Leaf turned(const Leaf& leaf, unsigned symmetry);

uint64_t hash(const Leaf& leaf);

}  // namespace filigree::encoding::sdag
