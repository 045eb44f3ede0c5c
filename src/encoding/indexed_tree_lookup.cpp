// What a lookup in an indexed tree reads: docs/spec/bits-read.md.
#include "filigree/encoding/indexed_tree.h"

#include "encoding/indexed_tree_layout.h"
#include "encoding/tree_layout.h"

namespace filigree::encoding {

uint64_t IndexedTreeReader::bitsRead(uint32_t map, uint32_t index) const {
    const TreeDescriptor found = loadTreeDescriptor(set_, map);
    const uint8_t* structure = set_.payload.data() + found.offset;
    const uint8_t* directory = structure + structureBytes(found.inner) + valueBytes(found.inner, set_.format);
    const filigree_tree_sample sample = filigree_tree_sample_before_(directory, found, index);
    const filigree_tree_node leaf = filigree_tree_leaf_from_(structure, sample, found.level, index);
    return 8 * treeDescriptorBytes + 8ull * sample.looked * sampleBytes(found.level) + leaf.bit -
           sample.top.bit + 1 + micromap::bitsPerState(set_.format);
}

}  // namespace filigree::encoding
