#include "filigree/encoding/indexed_tree.h"

#include "encoding/indexed_tree_layout.h"
#include "encoding/skip_table.h"
#include "encoding/tree_layout.h"

#include <algorithm>
#include <bit>

namespace filigree::encoding {

namespace {

// The sum of the base-4 digits of a curve index.
uint32_t digitSum(uint32_t index) {
    index = (index & 0x33333333) + (index >> 2 & 0x33333333);
    index = (index & 0x0f0f0f0f) + (index >> 4 & 0x0f0f0f0f);
    return index * 0x01010101 >> 24;
}

// A node: where it stands in the structure, and its depth.
struct Node {
    uint32_t bit = 0;
    unsigned depth = 0;
};

// Where the nodes that begin at one curve index begin in the structure, and that index.
struct Sample {
    Node top;
    uint32_t first = 0;
    unsigned looked = 0;  // how many entries of the directory led to it
};

// Before the top node at `first` there are b leaves and a inner nodes with 3a - b = 3 depth -
// digitSum(first), since each inner node on the way down has 3 minus its digit of children still to come.
Sample sampleAt(uint32_t first, uint32_t leavesBefore, unsigned level) {
    const unsigned depth = topDepth(first, level);
    return {{depth + (4 * leavesBefore - digitSum(first)) / 3, depth}, first};
}

// The last sample at or before `index`.
Sample sampleBefore(const uint8_t* directory, const TreeDescriptor& map, uint32_t index) {
    uint32_t sample = 0;
    uint32_t first = 0;
    unsigned looked = 0;
    for (uint64_t left = sampleCount(map.inner); left > 0;) {
        const auto half = static_cast<uint32_t>((left + 1) / 2);
        const uint32_t middle = loadSample(directory, sample + half, map.level);
        const bool after = middle > index;
        sample = after ? sample : sample + half;
        first = after ? first : middle;
        left = after ? half - 1 : left - half;
        ++looked;
    }
    Sample found = sampleAt(first, sample * static_cast<uint32_t>(sampleStep), map.level);
    found.looked = looked;
    return found;
}

// The leaf that holds `index`, from a node at or before it in the structure.
Node leafFrom(const uint8_t* structure, const Sample& sample, unsigned level, uint32_t index) {
    // The nearest ancestor of `index` at or after the sample's top, and how many subtrees stand before it.
    const auto same = static_cast<unsigned>(std::bit_width(sample.first ^ index) + 1) / 2;
    Node node{sample.top.bit, std::min(sample.top.depth, level + 1 - same)};
    uint32_t skip = 3 * (sample.top.depth - node.depth) + digitSum(index >> (2 * (level - node.depth))) -
                    digitSum(sample.first);
    for (;;) {
        const unsigned bits = loadLe<uint16_t>(structure + node.bit / 8) >> (node.bit % 8);
        const uint64_t entry = skipTable[bits & 255];
        const unsigned length = skipLength(entry, skip);
        if (skip != 0 && length == 0) {
            skip += skipBalance(entry);
            node.bit += 8;
            continue;
        }
        node.bit += length;
        if ((bits >> length & 1) == 0) return node;
        ++node.bit;
        ++node.depth;
        skip = index >> (2 * (level - node.depth)) & 3;
    }
}

}  // namespace

micromap::State IndexedTreeReader::at(uint32_t map, uint32_t index) const {
    const TreeDescriptor found = loadTreeDescriptor(set_, map);
    const uint8_t* structure = set_.payload.data() + found.offset;
    const uint8_t* values = structure + structureBytes(found.inner);
    const uint8_t* directory = values + valueBytes(found.inner, set_.format);
    const Node leaf = leafFrom(structure, sampleBefore(directory, found, index), found.level, index);
    // The relation of sampleAt(), solved for the leaves before.
    const uint32_t digits = digitSum(index >> (2 * (found.level - leaf.depth)));
    return valueAt(values, (3 * (leaf.bit - leaf.depth) + digits) / 4, set_.format);
}

uint64_t IndexedTreeReader::bitsRead(uint32_t map, uint32_t index) const {
    const TreeDescriptor found = loadTreeDescriptor(set_, map);
    const uint8_t* structure = set_.payload.data() + found.offset;
    const uint8_t* directory = structure + structureBytes(found.inner) + valueBytes(found.inner, set_.format);
    const Sample sample = sampleBefore(directory, found, index);
    const Node leaf = leafFrom(structure, sample, found.level, index);
    return 8 * treeDescriptorBytes + 8ull * sample.looked * sampleBytes(found.level) + leaf.bit -
           sample.top.bit + 1 + micromap::bitsPerState(set_.format);
}

}  // namespace filigree::encoding
