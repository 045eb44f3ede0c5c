#include "filigree/encoding/indexed_tree.h"

#include "encoding/checks.h"
#include "encoding/indexed_tree_layout.h"
#include "encoding/tree_read.h"

namespace filigree::encoding {
namespace {

uint64_t loadBytes(const uint8_t* from, unsigned bytes) {
    uint64_t value = 0;
    for (unsigned k = 0; k < bytes; ++k) value |= uint64_t{from[k]} << (8 * k);
    return value;
}

const char* checkDirectory(const TreeStructure& tree, std::span<const uint8_t> directory) {
    const unsigned bytes = sampleBytes(tree.level);
    uint64_t leaf = 0;
    size_t at = 0;
    bool wrong = false;
    walkTree(tree, [&](uint64_t first, unsigned) {
        if (leaf > 0 && leaf % sampleStep == 0) {
            wrong = wrong || loadBytes(directory.data() + at, bytes) != first;
            at += bytes;
        }
        ++leaf;
    });
    return wrong ? "has a directory of another tree" : nullptr;
}

}  // namespace

Result<IndexedTreeReader> IndexedTreeReader::open(const EncodedView& set) {
    const TreeRules rules{directoryBytes, checkDirectory, indexedTreeTailBytes};
    if (const auto status = checkTrees(set, rules); !status) return status.error();
    return IndexedTreeReader(set, openedAs<filigree_indexed_tree>(filigree_indexed_tree_open, set));
}

micromap::Quadtree IndexedTreeReader::decode(uint32_t map) const {
    return decodeTree(set_, map);
}

std::vector<Part> IndexedTreeReader::parts() const {
    const TreeBits bits = countTreeBits(set_);
    uint64_t directory = 0;
    for (uint32_t map = 0; map < set_.mapCount; ++map) {
        const TreeDescriptor found = loadTreeDescriptor(set_, map);
        directory += 8 * directoryBytes(found.inner, found.level);
    }
    return {{"structure", bits.structure},
            {"values", bits.values},
            {"directory", directory},
            {"padding", 8 * uint64_t{set_.payload.size()} - bits.structure - bits.values - directory},
            {"descriptors", 8 * uint64_t{set_.descriptors.size()}}};
}

}  // namespace filigree::encoding
