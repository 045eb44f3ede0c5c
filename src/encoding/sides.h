// Micromaps with other states in the place of their own.
#pragma once

#include "filigree/micromap/quadtree.h"
#include "filigree/micromap/quadtree_writer.h"

namespace filigree::encoding {

template <class NewState>
int copyRestated(BitReader& from, unsigned height, const NewState& newState, BitWriter& to) {
    if (height == 0 || !from.takeBit()) {
        const auto state = newState(static_cast<micromap::State>(from.take(2)));
        return micromap::appendLeaf(to, height, static_cast<int>(state));
    }
    return micromap::appendInner(to, height,
                                 [&](unsigned) { return copyRestated(from, height - 1, newState, to); });
}

// `tree` with each state `s` as newState(s).
template <class NewState>
micromap::Quadtree restated(const micromap::QuadtreeView& tree, const NewState& newState) {
    BitReader from(tree.words, tree.bits);
    BitWriter to;
    copyRestated(from, tree.level, newState, to);
    return {std::move(to), tree.level};
}

// `tree` with each state its opaque side, transparent or opaque: what 2-state keeps.
inline micromap::Quadtree sidesOf(const micromap::QuadtreeView& tree) {
    return restated(tree, [](micromap::State s) { return micromap::knownOf(micromap::isOpaqueSide(s)); });
}

}  // namespace filigree::encoding
