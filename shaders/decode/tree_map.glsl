// What `tree` and `indexed-tree` have in common: the descriptor and the two strings of bits of a map.
// docs/spec/tree.md.
#include "blocks.glsl"
#include "curve.glsl"

struct TreeMap {
    uint structure;  // byte in the payload where the structure begins
    uint values;     // byte where the values begin
    uint inner;      // inner nodes
    uint level;
};

TreeMap treeMap(uint map) {
    const uint begin = descriptorWords[2u * map];
    const uint shape = descriptorWords[2u * map + 1u];
    const uint inner = shape & 0xffffffu;
    return TreeMap(begin, begin + (4u * inner + 8u) / 8u, inner, shape >> 24);
}

bool isInnerNode(TreeMap tree, uint bit) {
    return ((payloadByte(tree.structure + (bit >> 3)) >> (bit & 7u)) & 1u) != 0u;
}
