// One micromap as nodes of 16 and leaves, in the frame of its symmetries.
#pragma once

#include "filigree/micromap/quadtree.h"

#include "encoding/sdag_leaf.h"

#include <array>
#include <cstdint>
#include <vector>

namespace filigree::encoding::sdag {

// What stands in the place of a part: the state of all of it, a leaf (parts of height 4), or a node (above).
using Entry = uint32_t;
constexpr bool isUniform(Entry entry) {
    return entry < 4;
}
constexpr bool isLeaf(Entry entry) {
    return entry >= 4 && entry % 2 == 1;
}
constexpr uint32_t indexOf(Entry entry) {
    return (entry - 4) / 2;
}
constexpr Entry nodeEntry(size_t index) {
    return static_cast<Entry>(4 + 2 * index);
}
constexpr Entry leafEntry(size_t index) {
    return static_cast<Entry>(5 + 2 * index);
}

struct SparseMap {
    unsigned height = leafHeight;  // of the root
    Entry root = 0;
    std::vector<std::array<Entry, 16>> nodes;  // by grandchild; children before parents
    std::vector<Leaf> leaves;
};

// With Format::twoState of the states' sides.
SparseMap sparseMap(const micromap::QuadtreeView& map, micromap::Format format);

// Turns all of it: what lay at a place lies at the turned place then.
void turn(SparseMap& map, unsigned symmetry);

}  // namespace filigree::encoding::sdag
