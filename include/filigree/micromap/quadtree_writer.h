// Writes canonical quadtree streams from the top down.
#pragma once

#include "filigree/core/bits.h"
#include "filigree/micromap/state.h"

#include <array>
#include <cstdint>

namespace filigree::micromap {

// A node of a quadtree stream lies at a height: how many levels are below it, 0 at the finest. Node functions
// return the node's state when it is one leaf, else -1, so that parents can merge.

// Appends a leaf.
inline int appendLeaf(BitWriter& stream, unsigned height, int state) {
    const auto value = static_cast<uint64_t>(state);
    if (height > 0) {
        stream.append(value << 1, 3);
    } else {
        stream.append(value, 2);
    }
    return state;
}

// Ends a node whose four children are in the stream: those that turned out leaves of one state are taken back
// and the node becomes that leaf. `start` is the stream's size before the node.
inline int endInner(BitWriter& stream, size_t start, unsigned height, const std::array<int, 4>& states) {
    const bool alike =
        states[0] >= 0 && states[1] == states[0] && states[2] == states[0] && states[3] == states[0];
    if (!alike) return -1;
    stream.truncate(start);
    return appendLeaf(stream, height, states[0]);
}

// Appends a node at height > 0 whose children are appended by child(0), .. child(3).
template <class Child>
int appendInner(BitWriter& stream, unsigned height, Child&& child) {
    const size_t start = stream.size();
    stream.append(1, 1);
    std::array<int, 4> states{};
    for (unsigned k = 0; k < 4; ++k) states[k] = child(k);
    return endInner(stream, start, height, states);
}

}  // namespace filigree::micromap
