// Constants and rules of docs/spec/dag.md.
#pragma once

#include "filigree/micromap/state.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace filigree::encoding::dag {

inline constexpr size_t wordBytes = 4;
inline constexpr size_t descriptorBytes = 4;
inline constexpr unsigned rootBits = 28;  // of a descriptor; the others hold the level
inline constexpr uint32_t rootMask = (1u << rootBits) - 1;
inline constexpr uint64_t maxWords = uint64_t{1} << rootBits;

inline constexpr unsigned leafHeight = 4;   // levels below a leaf node
inline constexpr unsigned blockHeight = 2;  // levels below a child of any leaf node
inline constexpr unsigned children = 16;
inline constexpr uint32_t childBits = 0xffff;

// How many levels lie below a map's root node.
constexpr unsigned rootHeight(unsigned level) {
    return std::max(leafHeight, level + level % 2);
}

// The opaque share of a node of `height` in 65535ths, rounded to nearest, halves up.
constexpr uint32_t shareOf(uint64_t opaque, unsigned height) {
    const uint64_t total = micromap::microTriangleCount(height);
    return static_cast<uint32_t>((2 * 65535 * opaque + total) / (2 * total));
}

// Words of the masks of a leaf with so many blocks.
constexpr unsigned maskWords(unsigned blocks, micromap::Format format) {
    return format == micromap::Format::fourState ? blocks : (blocks + 1) / 2;
}

}  // namespace filigree::encoding::dag
