// The bytes of succinct quadtrees: docs/spec/tree.md.
#pragma once

#include "filigree/core/bytes.h"
#include "filigree/encoding/encoded_set.h"
#include "filigree/micromap/state.h"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace filigree::encoding {

inline constexpr uint64_t treeDescriptorBytes = 8;

// Of a tree of `inner` inner nodes.
constexpr uint64_t structureBits(uint64_t inner) {
    return 4 * inner + 1;
}
constexpr uint64_t leafCount(uint64_t inner) {
    return 3 * inner + 1;
}
constexpr uint64_t structureBytes(uint64_t inner) {
    return (structureBits(inner) + 7) / 8;
}
constexpr uint64_t valueBytes(uint64_t inner, micromap::Format format) {
    return (leafCount(inner) * micromap::bitsPerState(format) + 7) / 8;
}

// One map: where it stands in the payload and what it holds.
struct TreeDescriptor {
    uint32_t offset = 0;
    uint32_t inner = 0;  // inner nodes, below 2^24
    unsigned level = 0;
};

inline TreeDescriptor loadTreeDescriptor(const EncodedView& set, uint32_t map) {
    const uint8_t* from = set.descriptors.data() + treeDescriptorBytes * map;
    const auto shape = loadLe<uint32_t>(from + 4);
    return {loadLe<uint32_t>(from), shape & 0xffffff, shape >> 24};
}

inline void storeTreeDescriptor(uint8_t* to, const TreeDescriptor& map) {
    storeLe(to, map.offset);
    storeLe(to + 4, map.inner | map.level << 24);
}

// The depth of the highest node that begins at curve index `first`. Nodes that begin at one index are a run
// of inner nodes and a leaf in the structure.
inline unsigned topDepth(uint64_t first, unsigned level) {
    if (first == 0) return 0;
    return level - std::min(level, static_cast<unsigned>(std::countr_zero(first)) / 2);
}

inline unsigned bitAt(const uint8_t* bytes, uint64_t bit) {
    return bytes[bit / 8] >> (bit % 8) & 1u;
}

inline micromap::State valueAt(const uint8_t* values, uint64_t leaf, micromap::Format format) {
    if (format == micromap::Format::twoState) return static_cast<micromap::State>(bitAt(values, leaf));
    return static_cast<micromap::State>(values[leaf / 4] >> (leaf % 4 * 2) & 3u);
}

}  // namespace filigree::encoding
