#include "encoding/tree_read.h"

#include "filigree/micromap/quadtree_writer.h"

#include "encoding/checks.h"

#include <algorithm>

namespace filigree::encoding {

using micromap::Format;
using micromap::State;

namespace {

// Counts how many leaves of one depth and state end with the last one.
class EqualLeaves {
  public:
    // True when the leaf ends four siblings alike, which a shorter tree would merge.
    bool endsFour(uint64_t first, unsigned depth, State state, unsigned level) {
        run_ = depth == depth_ && state == state_ ? run_ + 1 : 1;
        depth_ = depth;
        state_ = state;
        const bool last = depth > 0 && ((first >> (2 * (level - depth))) & 3) == 3;
        return last && run_ >= 4;
    }

  private:
    unsigned run_ = 0;
    unsigned depth_ = 0;
    State state_ = State::transparent;
};

bool spareBitsSet(std::span<const uint8_t> bytes, uint64_t bits) {
    return bits % 8 != 0 && (bytes[bits / 8] >> (bits % 8)) != 0;
}

// Null, or what is wrong with the two strings of a map.
const char* checkStrings(const TreeStructure& tree, std::span<const uint8_t> values, Format format) {
    const uint64_t leaves = leafCount(tree.inner);
    uint64_t leaf = 0;
    bool mergeable = false;
    EqualLeaves equal;
    const char* wrong = walkTree(tree, [&](uint64_t first, unsigned depth) {
        // A structure that goes wrong may have any number of leaves.
        if (leaf == leaves) return;
        const State state = valueAt(values.data(), leaf++, format);
        mergeable = equal.endsFour(first, depth, state, tree.level) || mergeable;
    });
    if (wrong != nullptr) return wrong;
    if (mergeable) return "has four siblings of one state, expected their parent";
    if (spareBitsSet({tree.bytes, structureBytes(tree.inner)}, structureBits(tree.inner)) ||
        spareBitsSet(values, leaves * micromap::bitsPerState(format))) {
        return "has spare bits that are set";
    }
    return nullptr;
}

// Map `map` stands at `begin`; moves `begin` to its end.
Status checkMap(const EncodedView& set, uint32_t map, const TreeRules& rules, uint64_t& begin) {
    const TreeDescriptor found = loadTreeDescriptor(set, map);
    if (found.offset != begin) {
        return formatError("descriptors: map {}: offset {}, expected {}", map, found.offset, begin);
    }
    if (found.level > micromap::maxLevel) {
        return formatError("descriptors: map {}: level {}, expected at most {}", map, found.level,
                           micromap::maxLevel);
    }
    const uint64_t structure = structureBytes(found.inner);
    const uint64_t values = valueBytes(found.inner, set.format);
    const uint64_t extra = rules.extraBytes(found.inner, found.level);
    if (structure + values + extra > set.payload.size() - begin) {
        return formatError("payload: {} bytes, map {} needs bytes {} to {}", set.payload.size(), map, begin,
                           begin + structure + values + extra);
    }
    const auto bytes = set.payload.subspan(begin, structure + values + extra);
    const TreeStructure tree{bytes.data(), found.inner, found.level};
    const char* wrong = checkStrings(tree, bytes.subspan(structure, values), set.format);
    if (wrong == nullptr) wrong = rules.checkExtra(tree, bytes.subspan(structure + values));
    if (wrong != nullptr) return formatError("payload: map {} at byte {} {}", map, begin, wrong);
    begin += bytes.size();
    return {};
}

}  // namespace

Status checkTrees(const EncodedView& set, const TreeRules& rules) {
    if (const auto size = checkDescriptorBytes(set, treeDescriptorBytes); !size) return size;
    uint64_t end = 0;
    for (uint32_t map = 0; map < set.mapCount; ++map) {
        if (const auto status = checkMap(set, map, rules, end); !status) return status;
    }
    if (end + rules.tailBytes != set.payload.size()) {
        return formatError("payload: {} bytes, expected {} for {} maps", set.payload.size(),
                           end + rules.tailBytes, set.mapCount);
    }
    const auto tail = set.payload.subspan(end);
    if (std::ranges::any_of(tail, [](uint8_t byte) { return byte != 0; })) {
        return formatError("payload: the last {} bytes are not zero", rules.tailBytes);
    }
    return {};
}

micromap::Quadtree decodeTree(const EncodedView& set, uint32_t map) {
    const TreeDescriptor found = loadTreeDescriptor(set, map);
    const uint8_t* structure = set.payload.data() + found.offset;
    const uint8_t* values = structure + structureBytes(found.inner);
    BitWriter stream;
    uint64_t leaf = 0;
    walkTree({structure, found.inner, found.level}, [&](uint64_t first, unsigned depth) {
        const unsigned above = depth - topDepth(first, found.level);
        stream.append((uint64_t{1} << above) - 1, above);
        const State state = valueAt(values, leaf++, set.format);
        micromap::appendLeaf(stream, found.level - depth, static_cast<int>(state));
    });
    return {std::move(stream), found.level};
}

TreeBits countTreeBits(const EncodedView& set) {
    TreeBits bits;
    for (uint32_t map = 0; map < set.mapCount; ++map) {
        const TreeDescriptor found = loadTreeDescriptor(set, map);
        bits.structure += structureBits(found.inner);
        bits.values += leafCount(found.inner) * micromap::bitsPerState(set.format);
    }
    return bits;
}

}  // namespace filigree::encoding
