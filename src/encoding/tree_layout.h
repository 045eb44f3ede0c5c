// The bytes of succinct quadtrees: docs/spec/tree.md.
#pragma once

#include "filigree/core/bytes.h"
#include "filigree/encoding/encoded_set.h"
#include "filigree/micromap/state.h"

#include "filigree_lookup.h"

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
    return filigree_tree_structure_bytes(inner);
}
constexpr uint64_t valueBytes(uint64_t inner, micromap::Format format) {
    return filigree_tree_value_bytes(inner, format == micromap::Format::fourState ? 1 : 0);
}

// One map: where it stands in the payload and what it holds.
using TreeDescriptor = filigree_tree_map;

inline TreeDescriptor loadTreeDescriptor(const EncodedView& set, uint32_t map) {
    return filigree_tree_map_(set.descriptors.data() + treeDescriptorBytes * map);
}

inline void storeTreeDescriptor(uint8_t* to, const TreeDescriptor& map) {
    storeLe(to, map.offset);
    storeLe(to + 4, map.inner | map.level << 24);
}

// The depth of the highest node that begins at curve index `first`. Nodes that begin at one index are a run
// of inner nodes and a leaf in the structure.
inline unsigned topDepth(uint64_t first, unsigned level) {
    return filigree_tree_top_depth_(static_cast<uint32_t>(first), level);
}

inline unsigned bitAt(const uint8_t* bytes, uint64_t bit) {
    return filigree_bit_(bytes, static_cast<uint32_t>(bit));
}

inline micromap::State valueAt(const uint8_t* values, uint64_t leaf, micromap::Format format) {
    const unsigned shift = format == micromap::Format::fourState ? 1 : 0;
    return static_cast<micromap::State>(
        filigree_value_(values, static_cast<uint32_t>(leaf), shift, 2 * shift + 1));
}

}  // namespace filigree::encoding
