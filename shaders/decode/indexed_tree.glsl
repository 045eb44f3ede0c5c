// Encoding `indexed-tree`: succinct quadtrees with a directory of every 64th leaf (Waldemarson and Doggett 2024,
// section 6.1, ask for one). docs/spec/indexed-tree.md.
#include "tree_map.glsl"

// The sum of the base-4 digits of a curve index.
uint digitSum(uint index) {
    index = (index & 0x33333333u) + ((index >> 2) & 0x33333333u);
    index = (index & 0x0f0f0f0fu) + ((index >> 4) & 0x0f0f0f0fu);
    return (index * 0x01010101u) >> 24;
}

// Where the highest node that begins at curve index `first` stands in the structure.
struct TreeSample {
    uint first;
    uint depth;
    uint bit;
};

TreeSample treeSample(uint first, uint leavesBefore, uint level) {
    const uint zeroDigits = first == 0u ? level : min(level, uint(findLSB(first)) / 2u);
    const uint depth = level - zeroDigits;
    return TreeSample(first, depth, depth + (4u * leavesBefore - digitSum(first)) / 3u);
}

// The last sample of the directory at or before `index`, or the root.
TreeSample sampleBefore(TreeMap tree, uint index) {
    const uint directory = tree.values + ((((3u * tree.inner + 1u) << widthShift) + 7u) >> 3);
    const uint bytes = (2u * tree.level + 7u) / 8u;
    uint sample_ = 0u;
    uint first = 0u;
    for (uint left = 3u * tree.inner / 64u; left > 0u;) {
        const uint step = (left + 1u) / 2u;
        const uint middle = payloadBits(directory + (sample_ + step - 1u) * bytes, 0u, 8u * bytes);
        const bool after = middle > index;
        sample_ = after ? sample_ : sample_ + step;
        first = after ? first : middle;
        left = after ? step - 1u : left - step;
    }
    return treeSample(first, 64u * sample_, tree.level);
}

// Behind `skip` subtrees: an inner node leaves three more to skip, a leaf one fewer.
uint skipSubtrees(TreeMap tree, uint bit, uint skip) {
    while (skip > 0u) skip = isInnerNode(tree, bit++) ? skip + 3u : skip - 1u;
    return bit;
}

// The state of a map at weights u and v of vertices 1 and 2.
uint stateAt(uint map, float u, float v) {
    const TreeMap tree = treeMap(map);
    const uint index = curveIndex(u, v, tree.level);
    const TreeSample from = sampleBefore(tree, index);
    const uint differing = uint(findMSB(from.first ^ index) + 2) / 2u;  // digits from the first that differs on
    uint depth = min(from.depth, tree.level + 1u - differing);
    const uint behind = 3u * (from.depth - depth) + digitSum(index >> (2u * (tree.level - depth)));
    uint bit = skipSubtrees(tree, from.bit, behind - digitSum(from.first));
    while (isInnerNode(tree, bit)) {
        ++depth;
        bit = skipSubtrees(tree, bit + 1u, (index >> (2u * (tree.level - depth))) & 3u);
    }
    const uint digits = digitSum(index >> (2u * (tree.level - depth)));
    return payloadState(tree.values, (3u * (bit - depth) + digits) / 4u);
}
