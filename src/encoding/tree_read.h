// Reads succinct quadtrees in order: checking them, and decoding what was checked.
#pragma once

#include "filigree/core/result.h"
#include "filigree/encoding/encoded_set.h"
#include "filigree/micromap/quadtree.h"

#include "encoding/tree_layout.h"

#include <cstdint>
#include <span>

namespace filigree::encoding {

// The structure of one map. `level` is at most maxLevel and the bits are there; all else may be wrong.
struct TreeStructure {
    const uint8_t* bytes = nullptr;
    uint64_t inner = 0;
    unsigned level = 0;
};

// Calls leaf(first, depth) for each leaf in order: it covers the 4^(level - depth) micro-triangles from curve
// index `first` on. Gives null, or what is wrong with the structure; the leaves before that were called.
template <class Leaf>
const char* walkTree(const TreeStructure& tree, Leaf&& leaf) {
    const uint64_t bits = structureBits(tree.inner);
    const uint64_t count = micromap::microTriangleCount(tree.level);
    uint64_t first = 0;
    unsigned depth = 0;
    uint64_t bit = 0;
    while (first < count) {
        if (bit == bits) return "ends within the tree";
        if (bitAt(tree.bytes, bit++) != 0) {
            if (++depth > tree.level) return "has an inner node at the finest level";
            continue;
        }
        leaf(first, depth);
        first += micromap::microTriangleCount(tree.level - depth);
        // Climb to the ancestor that has another child to come.
        while (depth > 0 && (first & (micromap::microTriangleCount(tree.level - depth + 1) - 1)) == 0)
            --depth;
    }
    return bit == bits ? nullptr : "goes on behind the tree";
}

// What follows the two strings of each map, and all maps; as in TreeExtras.
struct TreeRules {
    uint64_t (*extraBytes)(uint64_t inner, unsigned level);
    // Null, or what is wrong with a map's extra bytes. The structure was checked.
    const char* (*checkExtra)(const TreeStructure& tree, std::span<const uint8_t> extra);
    uint64_t tailBytes;
};

// Checks every byte of `set`.
Status checkTrees(const EncodedView& set, const TreeRules& rules);

// The quadtree of a map that was checked.
micromap::Quadtree decodeTree(const EncodedView& set, uint32_t map);

// Bits of all structures and of all values.
struct TreeBits {
    uint64_t structure = 0;
    uint64_t values = 0;
};
TreeBits countTreeBits(const EncodedView& set);

}  // namespace filigree::encoding
