#include "filigree/encoding/tree.h"

#include "encoding/checks.h"
#include "encoding/tree_read.h"

namespace filigree::encoding {

Result<TreeReader> TreeReader::open(const EncodedView& set) {
    const TreeRules none{
        [](uint64_t, unsigned) { return uint64_t{0}; },
        [](const TreeStructure&, std::span<const uint8_t>) -> const char* { return nullptr; }, 0};
    if (const auto status = checkTrees(set, none); !status) return status.error();
    return TreeReader(set, openedAs<filigree_tree>(filigree_tree_open, set));
}

micromap::Quadtree TreeReader::decode(uint32_t map) const {
    return decodeTree(set_, map);
}

std::vector<Part> TreeReader::parts() const {
    const TreeBits bits = countTreeBits(set_);
    return {{"structure", bits.structure},
            {"values", bits.values},
            {"padding", 8 * uint64_t{set_.payload.size()} - bits.structure - bits.values},
            {"descriptors", 8 * uint64_t{set_.descriptors.size()}}};
}

}  // namespace filigree::encoding
