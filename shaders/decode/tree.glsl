// Encoding `tree`: succinct quadtrees that are read by scanning (Waldemarson and Doggett 2024, algorithm 3).
// docs/spec/tree.md.
#include "tree_map.glsl"

// The state of a map at weights u and v of vertices 1 and 2.
uint stateAt(uint map, float u, float v) {
    const TreeMap tree = treeMap(map);
    const uint index = curveIndex(u, v, tree.level);
    uint bit = 0u;
    uint leaf = 0u;
    uint depth = 0u;
    while (isInnerNode(tree, bit)) {
        ++bit;
        ++depth;
        uint skip = (index >> (2u * (tree.level - depth))) & 3u;
        while (skip > 0u) {
            const bool inner = isInnerNode(tree, bit);
            ++bit;
            skip = inner ? skip + 3u : skip - 1u;
            leaf += inner ? 0u : 1u;
        }
    }
    return payloadState(tree.values, leaf);
}
