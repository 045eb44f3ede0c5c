#include "filigree/encoding/tree.h"

#include "encoding/tree_write.h"

namespace filigree::encoding {

Result<EncodedSet> encodeTree(std::span<const micromap::QuadtreeView> maps, micromap::Format format,
                              const Executor& executor, ProgressSink& progress) {
    const TreeExtras none{[](uint64_t, unsigned) { return uint64_t{0}; },
                          [](const micromap::QuadtreeView&, std::span<uint8_t>) {}, 0};
    return writeTrees(Encoding::tree, maps, format, none, executor, progress);
}

}  // namespace filigree::encoding
