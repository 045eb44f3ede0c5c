// The encodings that every test runs over, and what they keep of a micromap.
#pragma once

#include "filigree/encoding/encoded_set.h"
#include "filigree/micromap/quadtree.h"
#include "filigree/micromap/quadtree_writer.h"

#include <array>

namespace filigree::tests {

// Encodings of MapReader's maps.
inline constexpr std::array testedEncodings{
    encoding::Encoding::flat,        encoding::Encoding::gruen, encoding::Encoding::tree,
    encoding::Encoding::indexedTree, encoding::Encoding::dag,   encoding::Encoding::sdag,
};

// What an encoding gives back for a state that went in.
inline micromap::State storedState(encoding::Encoding encoding, micromap::Format format,
                                   micromap::State state) {
    if (format == micromap::Format::twoState) return micromap::knownOf(micromap::isOpaqueSide(state));
    const bool oneUnknown = encoding == encoding::Encoding::gruen;
    return oneUnknown && !micromap::isKnown(state) ? micromap::State::unknownOpaque : state;
}

// Appends the node of which stateOf(first, height) gives the state, or -1 where it must be split; `first` is
// its first micro-triangle.
template <class StateOf>
int appendNode(BitWriter& stream, uint64_t first, unsigned height, StateOf&& stateOf) {
    const int state = stateOf(first, height);
    if (state >= 0) return micromap::appendLeaf(stream, height, state);
    return micromap::appendInner(stream, height, [&](unsigned k) {
        const uint64_t child = first + k * micromap::microTriangleCount(height - 1);
        return appendNode(stream, child, height - 1, stateOf);
    });
}

template <class StateOf>
micromap::Quadtree build(unsigned level, StateOf&& stateOf) {
    BitWriter stream;
    appendNode(stream, 0, level, stateOf);
    return {std::move(stream), level};
}

// The canonical quadtree of what an encoding gives back for `map`.
inline micromap::Quadtree storedMap(encoding::Encoding encoding, micromap::Format format,
                                    const micromap::QuadtreeView& map) {
    BitReader reader(map.words, map.bits);
    return build(map.level, [&](uint64_t, unsigned height) {
        if (height > 0 && reader.takeBit()) return -1;
        const auto state = static_cast<micromap::State>(reader.take(2));
        return static_cast<int>(storedState(encoding, format, state));
    });
}

}  // namespace filigree::tests
