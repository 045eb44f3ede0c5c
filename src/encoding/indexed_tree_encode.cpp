#include "filigree/encoding/indexed_tree.h"

#include "encoding/indexed_tree_layout.h"
#include "encoding/tree_write.h"

namespace filigree::encoding {
namespace {

void writeDirectory(const micromap::QuadtreeView& tree, std::span<uint8_t> to) {
    const unsigned bytes = sampleBytes(tree.level);
    uint64_t leaf = 0;
    size_t at = 0;
    forEachLeaf(tree, [&](uint64_t first, unsigned, micromap::State) {
        if (leaf > 0 && leaf % sampleStep == 0) {
            for (unsigned k = 0; k < bytes; ++k) to[at++] = static_cast<uint8_t>(first >> (8 * k));
        }
        ++leaf;
    });
}

}  // namespace

Result<EncodedSet> encodeIndexedTree(std::span<const micromap::QuadtreeView> maps, micromap::Format format,
                                     const Executor& executor, ProgressSink& progress) {
    const TreeExtras directory{directoryBytes, writeDirectory, indexedTreeTailBytes};
    return writeTrees(Encoding::indexedTree, maps, format, directory, executor, progress);
}

}  // namespace filigree::encoding
