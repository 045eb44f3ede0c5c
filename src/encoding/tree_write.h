// Writes sets of succinct quadtrees, with a directory behind each or without.
#pragma once

#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/encoding/encoded_set.h"
#include "filigree/micromap/quadtree.h"

#include <cstdint>
#include <span>

namespace filigree::encoding {

// What follows the two bit strings of a map, and all maps.
struct TreeExtras {
    uint64_t (*bytes)(uint64_t inner, unsigned level);
    void (*write)(const micromap::QuadtreeView& tree, std::span<uint8_t> to);
    uint64_t tailBytes;
};

Result<EncodedSet> writeTrees(Encoding encoding, std::span<const micromap::QuadtreeView> maps,
                              micromap::Format format, const TreeExtras& extras, const Executor& executor,
                              ProgressSink& progress);

}  // namespace filigree::encoding
