// The directory of indexed trees: docs/spec/indexed-tree.md.
#pragma once

#include "filigree_lookup.h"

#include <cstdint>

namespace filigree::encoding {

// Every `sampleStep`-th leaf but the first stands in the directory.
inline constexpr uint64_t sampleStep = FILIGREE_TREE_SAMPLE_STEP;

// Zero bytes at the end of the payload, so that 8 bytes can be loaded anywhere before.
inline constexpr uint64_t indexedTreeTailBytes = FILIGREE_INDEXED_TREE_TAIL_BYTES;

// A sample is the curve index that a leaf begins at.
constexpr unsigned sampleBytes(unsigned level) {
    return filigree_tree_sample_bytes_(level);
}
constexpr uint64_t directoryBytes(uint64_t inner, unsigned level) {
    return filigree_tree_directory_bytes_(inner, level);
}

}  // namespace filigree::encoding
