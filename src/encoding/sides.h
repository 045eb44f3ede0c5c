// Micromaps without their unknown bits.
#pragma once

#include "filigree/micromap/quadtree.h"
#include "filigree/micromap/quadtree_writer.h"

namespace filigree::encoding {

inline int copySides(BitReader& from, unsigned height, BitWriter& to) {
    if (height == 0 || !from.takeBit()) {
        return micromap::appendLeaf(to, height, static_cast<int>(from.take(2) & 1));
    }
    return micromap::appendInner(to, height, [&](unsigned) { return copySides(from, height - 1, to); });
}

// `tree` with each state its opaque side, transparent or opaque: what 2-state keeps.
inline micromap::Quadtree sidesOf(const micromap::QuadtreeView& tree) {
    BitReader from(tree.words, tree.bits);
    BitWriter to;
    copySides(from, tree.level, to);
    return {std::move(to), tree.level};
}

}  // namespace filigree::encoding
